#include "commands/diff.h"

#include "commands/json_text.h"
#include "commands/output_folder.h"
#include "commands/render_command.h"
#include "error.h"
#include "film/auto_exposure.h"
#include "image/atomic_file.h"
#include "image/exr_writer.h"
#include "image/png_writer.h"
#include "measure/expectation.h"
#include "measure/maps.h"
#include "measure/picture_error.h"
#include "measure/pixels.h"
#include "page/page.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <bit>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace wavepath {

namespace {

constexpr int schema_version = 1;  // docs/diff.md
constexpr double alpha = 0.001;    // the level of the exit status

struct DiffOptions {
    std::filesystem::path a, b, reference;  // reference: empty for none
    std::filesystem::path folder, json;     // empty: not written
};

struct ErrorRow {
    std::string of, against;  // names of files
    double mse = 0, rel_mse = 0;
};

struct Diff {
    Image a, b;
    std::vector<ErrorRow> errors;
    Ratio ratio;
    std::size_t equal_pixels = 0;
    bool exchangeable = false;
    std::optional<double> p;

    std::size_t pixels() const { return std::size_t{a.width} * a.height; }
    bool differ() const { return p && *p < alpha; }
};

// Pixels whose R, G and B have the same bits, NaN included.
std::size_t count_equal(const Image& a, const Image& b) {
    const std::size_t pixels = std::size_t{a.width} * a.height;
    std::size_t equal = 0;
    for (std::size_t i = 0; i < pixels; ++i) {
        bool all = true;
        for (const char* channel : {"R", "G", "B"})
            all = all && std::bit_cast<uint32_t>(a.channels.at(channel)[i]) ==
                             std::bit_cast<uint32_t>(b.channels.at(channel)[i]);
        equal += all ? 1 : 0;
    }
    return equal;
}

Diff measure(const DiffOptions& options) {
    Diff diff;
    diff.a = read_exr(options.a);
    diff.b = read_exr(options.b);
    const std::string name_a = options.a.string();
    const std::string name_b = options.b.string();
    check_comparable(diff.a, name_a, diff.b, name_b);
    const auto add_error = [&](const Image& image, const std::string& of, const Image& against,
                               const std::string& name) {
        diff.errors.push_back({of, name, mse(image, against).value, rel_mse(image, against).value});
    };
    if (options.reference.empty()) {
        add_error(diff.a, name_a, diff.b, name_b);
    } else {
        const Image reference = read_exr(options.reference);
        const std::string name = options.reference.string();
        check_comparable(diff.a, name_a, reference, name);
        add_error(diff.a, name_a, reference, name);
        add_error(diff.b, name_b, reference, name);
    }
    diff.ratio = ratio_of_means(diff.a, diff.b);
    diff.equal_pixels = count_equal(diff.a, diff.b);
    diff.exchangeable = are_exchangeable(diff.a, diff.b);
    diff.p = p_of_same_expectation(diff.a, diff.b, diff.exchangeable);
    return diff;
}

std::string verdict_of(const Diff& diff) {
    if (!diff.p)
        return "cannot be told: too few pixels differ, or too few carry the noise; take more "
               "samples";
    return fmt::format(
        "p {} {:.2g}: {}{}", *diff.p < 1e-4 ? "<" : "=", *diff.p,
        diff.differ() ? "the expectations differ" : "no difference found",
        diff.exchangeable ? " (exact: one set of options)" : "");
}

// What is said of the pictures, line by line: name and value.
std::vector<std::vector<std::string>> lines_of(const Diff& diff) {
    std::vector<std::vector<std::string>> lines;
    for (const ErrorRow& row : diff.errors) {
        const std::string what = fmt::format("of {} against {}", row.of, row.against);
        lines.push_back({"MSE " + what, fmt::format("{:.4g}", row.mse)});
        lines.push_back({"relMSE " + what, fmt::format("{:.4g}", row.rel_mse)});
    }
    lines.push_back(
        {"ratio of means",
         fmt::format("{:.6g} +- {:.2g}", diff.ratio.value, diff.ratio.standard_error)});
    lines.push_back(
        {"pixels of the same bits", fmt::format(
                                        "{:.4g} %", 100 * static_cast<double>(diff.equal_pixels) /
                                                        static_cast<double>(diff.pixels()))});
    if (diff.ratio.left_out > 0)
        lines.push_back({"pixels left out, not finite", fmt::format("{}", diff.ratio.left_out)});
    lines.push_back({"same expectation", verdict_of(diff)});
    return lines;
}

nlohmann::ordered_json json_of(const DiffOptions& options, const Diff& diff) {
    nlohmann::ordered_json errors = nlohmann::ordered_json::array();
    for (const ErrorRow& row : diff.errors)
        errors.push_back(
            {{"of", row.of},
             {"against", row.against},
             {"mse", json_number(row.mse)},
             {"rel_mse", json_number(row.rel_mse)}});
    return {
        {"schema", "wavepath diff"},
        {"schema_version", schema_version},
        {"a", options.a.string()},
        {"b", options.b.string()},
        {"width", diff.a.width},
        {"height", diff.a.height},
        {"errors", errors},
        {"ratio_of_means", json_number(diff.ratio.value)},
        {"ratio_standard_error", json_number(diff.ratio.standard_error)},
        {"equal_pixels", diff.equal_pixels},
        {"left_out_pixels", diff.ratio.left_out},
        {"exchangeable", diff.exchangeable},
        {"p_same_expectation", diff.p ? json_number(*diff.p) : nullptr},
        {"alpha", alpha},
        {"differ", diff.differ()},
    };
}

void write_page(const DiffOptions& options, const Diff& diff) {
    const std::filesystem::path& folder = options.folder;
    const double exposure = auto_exposure(diff.b);
    write_png(diff.a, folder / "a.png", exposure);
    write_png(diff.b, folder / "b.png", exposure);
    const auto write_map = [&](const std::string& name, const std::vector<double>& values,
                               double full) {
        write_png(signed_picture(diff.a.width, diff.a.height, values, full), folder / name, 0);
    };
    constexpr double full_difference = 0.2;
    constexpr double full_z = 4;
    write_map("difference.png", relative_differences(diff.a, diff.b), full_difference);
    std::vector<Picture> pictures{
        {"A: " + options.a.string(), "a.png", render_command(diff.a)},
        {"B: " + options.b.string(), "b.png", render_command(diff.b)},
        {fmt::format(
             "A - B relative to both: vermilion where A is brighter by {0:.0f} % and more, blue "
             "where B is",
             100 * full_difference),
         "difference.png", ""}};
    if (const auto z = z_scores(diff.a, diff.b)) {
        write_map("z.png", *z, full_z);
        pictures.push_back(
            {fmt::format(
                 "z, A - B over its standard error by the variance layers, full at {:.0f}. "
                 "Conservative: the layers overstate the error of Sobol points",
                 full_z),
             "z.png", ""});
    }
    Page page(fmt::format("{} against {}", options.a.string(), options.b.string()));
    page.paragraph(fmt::format("Same expectation? {}.", verdict_of(diff)));
    page.table({.columns = {"measure", "value"}, .rows = lines_of(diff)});
    page.heading("Pictures");
    page.pictures(pictures);
    page.write(folder / "index.html");
}

void run_diff(const DiffOptions& options) {
    if (!options.json.empty()) check_writable(options.json);
    const Diff diff = measure(options);
    if (!options.folder.empty()) {
        make_output_folder(options.folder, "index.html");
        write_page(options, diff);
    }
    const std::string json = json_text(json_of(options, diff), 2) + "\n";
    if (!options.json.empty()) AtomicFile(options.json).commit(json);
    for (const auto& line : lines_of(diff)) fmt::print("{}: {}\n", line[0], line[1]);
    if (diff.differ()) throw ExpectationsDiffer();
}

}  // namespace

void add_diff_command(CLI::App& app) {
    CLI::App* command = app.add_subcommand(
        "diff", "Compare two pictures: errors, and whether they have one expectation");
    const auto options = std::make_shared<DiffOptions>();
    command->add_option("A", options->a, "A picture, .exr")->required()->type_name("A.exr");
    command->add_option("B", options->b, "Another, .exr")->required()->type_name("B.exr");
    command
        ->add_option(
            "--reference", options->reference,
            "Errors of both are against this; default of A "
            "against B")
        ->type_name("FILE.exr");
    command->add_option("-o,--output", options->folder, "Write a page with pictures and maps there")
        ->type_name("DIR");
    command->add_option("--json", options->json, "Write a report, as docs/diff.md describes it")
        ->type_name("FILE");
    command->footer(fmt::format(
        "Exit status: 0 no difference of expectations found; 3 they differ (p < {}); 1 an error.",
        alpha));
    command->callback([options] { run_diff(*options); });
}

}  // namespace wavepath
