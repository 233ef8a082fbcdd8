#include "commands/chart/chart_page.h"

#include "commands/json_text.h"
#include "commands/render_command.h"
#include "commands/report.h"
#include "film/auto_exposure.h"
#include "image/atomic_file.h"
#include "image/png_writer.h"
#include "measure/maps.h"
#include "page/page.h"

#include <algorithm>
#include <cmath>

namespace wavepath {

namespace {

using nlohmann::ordered_json;

constexpr int chart_schema = 1;

ordered_json interval(const Interval& of) {
    return {
        {"value", json_number(of.value)},
        {"low", json_number(of.low)},
        {"high", json_number(of.high)}};
}

std::string text(double value) {
    return std::isfinite(value) ? fmt::format("{:.3g}", value) : "-";
}

std::string text(const Interval& of) {
    if (!std::isfinite(of.value)) return "-";
    if (!std::isfinite(of.low) || !std::isfinite(of.high)) return text(of.value);
    return fmt::format("{:.3g} ({:.3g} to {:.3g})", of.value, of.low, of.high);
}

ordered_json curve_json(const VariantCurve& curve) {
    ordered_json points = ordered_json::array();
    for (const ChartPoint& point : curve.points)
        points.push_back(
            {{"samples", point.samples},
             {"seconds", point.seconds},
             {"mse", point.mse},
             {"rel_mse", point.rel_mses}});
    return {
        {"label", curve.label},
        {"command", curve.command},
        {"bias", curve.bias},
        {"verdict", name_of(curve.verdict)},
        {"points", points},
        {"slope_samples", interval(curve.slope_samples)},
        {"slope_time", interval(curve.slope_time)},
        {"efficiency_per_s", interval(curve.efficiency)},
        {"floor_rel_mse", interval(curve.floor)},
        {"tail_index", interval(curve.tail.index)},
        {"share_of_largest", json_number(curve.tail.share_of_largest)},
        {"variance_of_variance", json_number(curve.tail.variance_of_variance)},
        {"reference_rel_mse", json_number(curve.reference_rel_mse)},
        {"nonfinite_samples", curve.nonfinite_samples}};
}

ordered_json chart_json(const ChartResult& result) {
    ordered_json curves = ordered_json::array();
    for (const VariantCurve& curve : result.curves) curves.push_back(curve_json(curve));
    const auto winner = winner_of(result.curves);
    return {
        {"schema", chart_schema},
        {"program", "wavepath"},
        {"build", build_text()},
        {"scene", result.scene},
        {"device", result.device},
        {"width", result.width},
        {"height", result.height},
        {"seeds", result.seeds},
        {"interrupted", result.interrupted},
        {"reference",
         {{"text", result.reference.text}, {"rel_mse", json_number(result.reference.rel_mse)}}},
        {"winner", winner ? ordered_json(result.curves[*winner].label) : ordered_json(nullptr)},
        {"variants", curves}};
}

std::string chart_csv(const ChartResult& result) {
    std::string csv = "variant,samples,seed,seconds,mse,rel_mse\n";
    for (const VariantCurve& curve : result.curves)
        for (const ChartPoint& point : curve.points)
            for (std::size_t k = 0; k < point.seconds.size(); ++k)
                csv += fmt::format(
                    "\"{}\",{},{},{},{},{}\n", curve.label, point.samples, k + 1, point.seconds[k],
                    point.mse[k], point.rel_mses[k]);
    return csv;
}

// The lines that theory predicts for independent samples, and below which a biased variant or the
// reference does not get.
void add_guides(Chart& chart, const ChartResult& result, bool over_time) {
    double least = INFINITY;
    double most = 0;
    double product = 0;  // mean of log(x y)
    std::size_t count = 0;
    const auto x_of = [&](const ChartPoint& point) {
        return over_time ? point.median_seconds() : static_cast<double>(point.samples);
    };
    for (const VariantCurve& curve : result.curves)
        for (const ChartPoint& point : curve.points) {
            if (!(point.median_rel_mse() > 0)) continue;
            least = std::min(least, x_of(point));
            most = std::max(most, x_of(point));
            product += std::log(x_of(point) * point.median_rel_mse());
            ++count;
        }
    if (count == 0) return;
    const double c = std::exp(product / static_cast<double>(count));
    constexpr int grey = 6;
    chart.curves.push_back(
        {.name = "slope -1, of independent samples",
         .x = {least, most},
         .y = {c / least, c / most},
         .mark = Mark::dashed_line,
         .color = grey});
    if (result.reference.rel_mse > 0)
        chart.curves.push_back(
            {.name = "the reference's own error",
             .x = {least, most},
             .y = {result.reference.rel_mse, result.reference.rel_mse},
             .mark = Mark::line,
             .color = grey});
    for (std::size_t i = 0; i < result.curves.size(); ++i) {
        const VariantCurve& curve = result.curves[i];
        if (curve.verdict != ChartVerdict::biased || !(curve.floor.low > 0)) continue;
        chart.curves.push_back(
            {.name = "bias of " + curve.label,
             .x = {least, most},
             .y = {curve.floor.value, curve.floor.value},
             .mark = Mark::dashed_line,
             .color = static_cast<int>(i)});
    }
}

Chart error_chart(const ChartResult& result, bool over_time) {
    Chart chart;
    chart.title = fmt::format(
        "{}, {} x {}: relMSE, median and range of {} seeds", result.scene, result.width,
        result.height, result.seeds);
    chart.x_label = over_time ? "time of rendering [s]" : "samples a pixel";
    chart.y_label = "relative mean squared error";
    chart.log_x = chart.log_y = true;
    for (std::size_t i = 0; i < result.curves.size(); ++i) {
        Curve line;
        line.name = result.curves[i].label;
        line.color = static_cast<int>(i);
        for (const ChartPoint& point : result.curves[i].points) {
            line.x.push_back(
                over_time ? point.median_seconds() : static_cast<double>(point.samples));
            line.y.push_back(point.median_rel_mse());
            line.low.push_back(std::ranges::min(point.rel_mses));
            line.high.push_back(std::ranges::max(point.rel_mses));
        }
        chart.curves.push_back(std::move(line));
    }
    add_guides(chart, result, over_time);
    return chart;
}

Table table_of(const ChartResult& result) {
    Table table;
    table.columns = {
        "settings",
        "verdict",
        "samples",
        "time [s]",
        "relMSE",
        "efficiency [1/s], 95 %",
        "slope, samples",
        "slope, time",
        "floor of relMSE",
        "tail index",
        "share of the largest",
        "relMSE of the reference"};
    for (const VariantCurve& curve : result.curves) {
        const ChartPoint& last = curve.points.back();
        table.rows.push_back(
            {curve.label, name_of(curve.verdict), std::to_string(last.samples),
             text(last.median_seconds()), text(last.median_rel_mse()), text(curve.efficiency),
             text(curve.slope_samples), text(curve.slope_time), text(curve.floor),
             text(curve.tail.index), text(curve.tail.share_of_largest),
             text(curve.reference_rel_mse)});
    }
    return table;
}

std::string verdict_text(const ChartResult& result) {
    if (const auto winner = winner_of(result.curves))
        return fmt::format(
            "{} is the most efficient: the 95 % interval of its efficiency over that of each other "
            "sound one lies above 1.",
            result.curves[*winner].label);
    return "No winner is named: fewer than two settings are sound, or their intervals overlap.";
}

// Pictures of about the same time, and what they are off the reference.
void add_pictures(Page& page, const ChartResult& result, const std::filesystem::path& folder) {
    if (result.pictures.empty()) return;
    const double exposure = auto_exposure(result.reference.half1);
    std::vector<Picture> pictures;
    write_png(result.reference.half1, folder / "reference.png", exposure);
    pictures.push_back({"reference", "reference.png", render_command(result.reference.half1)});
    for (std::size_t i = 0; i < result.pictures.size(); ++i) {
        const ChartPicture& picture = result.pictures[i];
        const VariantCurve& curve = result.curves[picture.variant];
        const std::string name = fmt::format("picture{}.png", i);
        const std::string errors = fmt::format("error{}.png", i);
        write_png(picture.image, folder / name, exposure);
        write_png(
            signed_picture(
                result.width, result.height,
                relative_differences(picture.image, result.reference.half1), 0.5),
            folder / errors, 0);
        const std::string what =
            fmt::format("{}: {} samples, {:.3g} s", curve.label, picture.samples, picture.seconds);
        pictures.push_back({what, name, render_command(picture.image)});
        pictures.push_back({what + ", error", errors, ""});
    }
    page.heading("Pictures at equal time");
    page.paragraph(
        "Of the first seed, with the number of samples whose time is nearest to the longest that "
        "all settings have. Errors are relative to the radiance: vermilion is too bright by half "
        "and more, blue too dark. The wheel zooms all pictures, the pointer moves them; with the "
        "keyboard +, -, 0 and the arrows.");
    page.pictures(pictures);
}

}  // namespace

void write_chart(const ChartResult& result, const std::filesystem::path& folder) {
    AtomicFile(folder / "chart.json").commit(json_text(chart_json(result), 2) + "\n");
    AtomicFile(folder / "chart.csv").commit(chart_csv(result));
    Page page(fmt::format("{}: error against time", result.scene));
    page.paragraph(fmt::format(
        "{} x {} pixels on {}, {} seeds{}.", result.width, result.height, result.device,
        result.seeds, result.interrupted ? "; interrupted, so this is what there was" : ""));
    page.command(result.command);
    page.paragraph(verdict_text(result));
    page.chart(error_chart(result, true));
    page.chart(error_chart(result, false));
    page.table(table_of(result));
    page.heading("What the columns mean");
    page.paragraph(fmt::format(
        "relMSE is the mean of (A - R)^2 / (R^2 + 0.01) over pixels and channels. {} Its own "
        "relMSE is {}; errors below that of a setting's reference, in the last column, are not "
        "ranked.",
        result.reference.text, text(result.reference.rel_mse)));
    page.paragraph(
        "Efficiency is 1 / (relMSE x time). The floor is the squared bias, which more samples do "
        "not take away; it is about 0, of either sign, for what is unbiased. A tail index below 2 "
        "means a variance that is infinite: such settings are flagged and not ranked. Verdicts are "
        "judged at the largest number of samples.");
    add_pictures(page, result, folder);
    page.write(folder / "chart.html");
}

}  // namespace wavepath
