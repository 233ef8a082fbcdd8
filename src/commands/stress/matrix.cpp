#include "commands/stress/matrix.h"

#include "commands/json_text.h"
#include "page/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

namespace wavepath {

namespace {

constexpr int schema_version = 1;

template <typename Key>
void append_new(std::vector<Key>& keys, const Key& key) {
    if (std::ranges::find(keys, key) == keys.end()) keys.push_back(key);
}

// What a family's cells are ordered by, in the order of their first.
struct Axes {
    std::string abscissa;
    std::vector<std::string> methods;
    std::set<double> rows;
};

Axes axes_of(const std::vector<Cell>& cells, const std::string& family) {
    Axes axes;
    for (const Cell& cell : cells) {
        if (cell.situation.family != family) continue;
        axes.abscissa = cell.situation.abscissa;
        append_new(axes.methods, cell.situation.method);
        axes.rows.insert(cell.situation.x);
    }
    return axes;
}

const Cell* find(
    const std::vector<Cell>& cells,
    const std::string& family,
    const std::string& method,
    double row) {
    const auto found = std::ranges::find_if(cells, [&](const Cell& cell) {
        return cell.situation.family == family && cell.situation.method == method &&
               cell.situation.x == row;
    });
    return found == cells.end() ? nullptr : &*found;
}

std::string cell_text(const Cell& cell) {
    std::string text = name_of(cell.judgement.verdict);
    if (!cell.as_expected()) text += " (expected: " + name_of(cell.situation.expected) + ")";
    return text + ": " + words_of(cell);
}

Table table_of(const std::vector<Cell>& cells, const std::string& family, const Axes& axes) {
    Table table{.columns = {axes.abscissa}, .rows = {}};
    table.columns.insert(table.columns.end(), axes.methods.begin(), axes.methods.end());
    for (const double row : axes.rows) {
        std::vector<std::string> texts{fmt::format("{:g}", row)};
        for (const std::string& method : axes.methods) {
            const Cell* cell = find(cells, family, method, row);
            texts.push_back(cell ? cell_text(*cell) : "");
        }
        table.rows.push_back(texts);
    }
    return table;
}

// A variance that is more than rounding; else 0, which a logarithmic axis leaves out.
double shown(double relative_variance) {
    return relative_variance > 1e-12 ? relative_variance : 0;
}

// Relative variance against what the family varies: as measured, and as predicted.
Chart chart_of(const std::vector<Cell>& cells, const std::string& family, const Axes& axes) {
    Chart chart;
    chart.title = family;
    chart.x_label = axes.abscissa;
    chart.y_label = "relative variance of one sample";
    chart.log_x = chart.log_y = true;
    for (std::size_t m = 0; m < axes.methods.size(); ++m) {
        Curve measured;
        measured.name = axes.methods[m];
        measured.mark = Mark::points;
        Curve predicted;
        predicted.mark = Mark::dashed_line;
        measured.color = predicted.color = static_cast<int>(m);
        for (const double row : axes.rows) {
            const Cell* cell = find(cells, family, axes.methods[m], row);
            if (!cell) continue;
            measured.x.push_back(row);
            measured.y.push_back(shown(cell->judgement.relative_variance));
            if (!cell->situation.relative_variance) continue;
            predicted.x.push_back(row);
            predicted.y.push_back(shown(*cell->situation.relative_variance));
        }
        chart.curves.push_back(measured);
        if (predicted.x.size() > 1) chart.curves.push_back(predicted);
    }
    return chart;
}

// Whether there is something to draw.
bool varies(const std::vector<Cell>& cells, const std::string& family, const Axes& axes) {
    return axes.rows.size() > 1 && std::ranges::any_of(cells, [&](const Cell& cell) {
               return cell.situation.family == family &&
                      shown(cell.judgement.relative_variance) > 0;
           });
}

}  // namespace

std::string words_of(const Cell& cell) {
    const Judgement& j = cell.judgement;
    std::string text = fmt::format(
        "mean {:.5g} +- {:.1g}, rv {:.3g}", j.mean, j.standard_error, j.relative_variance);
    if (cell.situation.relative_variance)
        text += fmt::format(" ({:.3g})", *cell.situation.relative_variance);
    if (j.tail.infinite_variance)
        text += fmt::format(", tail index {:.2f}, slope {:.2f}", j.tail.index.value, j.slope.value);
    if (j.nonfinite > 0) text += fmt::format(", {} samples not finite", j.nonfinite);
    return text;
}

nlohmann::ordered_json json_of(const std::vector<Cell>& cells, const std::string& device) {
    const auto interval = [&](const Interval& i) {
        return nlohmann::ordered_json{
            json_number(i.value), json_number(i.low), json_number(i.high)};
    };
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const auto& [situation, judgement] : cells)
        rows.push_back({
            {"situation", situation.family},
            {"varied", situation.abscissa},
            {"x", situation.x},
            {"method", situation.method},
            {"samples", judgement.samples},
            {"seconds", judgement.seconds},
            {"truth", situation.truth},
            {"mean", json_number(judgement.mean)},
            {"standard_error", json_number(judgement.standard_error)},
            {"relative_variance", json_number(judgement.relative_variance)},
            {"predicted", situation.relative_variance ? json_number(*situation.relative_variance)
                                                      : nlohmann::ordered_json(nullptr)},
            {"tail_index", interval(judgement.tail.index)},
            {"slope", interval(judgement.slope)},
            {"nonfinite_samples", judgement.nonfinite},
            {"verdict", name_of(judgement.verdict)},
            {"expected", name_of(situation.expected)},
        });
    return {
        {"schema", "wavepath stress"},
        {"schema_version", schema_version},
        {"version", WAVEPATH_VERSION},
        {"device", device},
        {"cells", rows}};
}

void write_matrix(
    const std::vector<Cell>& cells,
    const std::string& device,
    const std::filesystem::path& folder) {
    Page page("Where estimators live and die");
    const auto unexpected =
        std::ranges::count_if(cells, [](const Cell& cell) { return !cell.as_expected(); });
    page.paragraph(fmt::format(
        "{} cells on {}: {} verdicts differ from those expected. Means are relative to the closed "
        "form, with their standard error; rv is the relative variance of one sample, in brackets "
        "as predicted. Noisy: an rv above {}, so that an error of 1 % takes more than {} samples.",
        cells.size(), device, unexpected, noisy_variance, 1e4 * noisy_variance));
    std::vector<std::string> families;
    for (const Cell& cell : cells) append_new(families, cell.situation.family);
    for (const std::string& family : families) {
        const Axes axes = axes_of(cells, family);
        page.heading(family);
        page.table(table_of(cells, family, axes));
        if (varies(cells, family, axes)) page.chart(chart_of(cells, family, axes));
    }
    page.write(folder / "index.html");
}

}  // namespace wavepath
