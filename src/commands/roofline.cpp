#include "commands/roofline.h"

#include "commands/json_text.h"
#include "device/program.h"

#include <algorithm>
#include <optional>

namespace wavepath {

using nlohmann::ordered_json;

namespace {

// The row of counts that was traced like the render; else the first, if there is any.
const ordered_json* counts_of(const ordered_json& kernels, const ProfileRow& row, const char* how) {
    const auto kernel = kernels.find(row.name);
    if (kernel == kernels.end()) return nullptr;
    const ordered_json& counts = (*kernel)["counts"];
    const auto same = std::ranges::find_if(
        counts, [&](const ordered_json& count) { return count.value("tracing", "") == how; });
    return same == counts.end() ? &counts.front() : &*same;
}

RooflineRow row_of(const ProfileRow& row, const ordered_json& count, const std::string& tracing) {
    RooflineRow result;
    result.kernel = row.name;
    result.flops_per_item = count["flops"];
    result.bytes_per_item = count["bytes"];
    const double items_per_s = static_cast<double>(row.items) / row.seconds;
    result.flops_per_s = result.flops_per_item * items_per_s;
    result.bytes_per_s = result.bytes_per_item * items_per_s;
    result.counted_on = count["scene"];
    if (count.contains("tracing")) {
        result.counted_on += ", " + count["tracing"].get<std::string>();
        result.same_tracing = count["tracing"] == tracing;
    }
    result.seconds = row.seconds;
    return result;
}

}  // namespace

double Roofline::share_of_roof(const RooflineRow& row) const {
    return std::max(row.flops_per_s / peaks.flops_per_s, row.bytes_per_s / peaks.bytes_per_s);
}

Roofline roofline_of(const RenderResult& result, const Peaks& peaks) {
    const ordered_json table = ordered_json::parse(kernel_file("counts.json"));
    Roofline roofline{peaks, table["counted_with"], {}};
    for (const ProfileRow& row : result.profile) {
        const ordered_json* count = counts_of(table["kernels"], row, result.tracing.c_str());
        if (count != nullptr && row.items > 0 && row.seconds > 0)
            roofline.rows.push_back(row_of(row, *count, result.tracing));
    }
    std::ranges::sort(roofline.rows, std::greater{}, &RooflineRow::seconds);
    return roofline;
}

ordered_json roofline_report(const Roofline& roofline) {
    ordered_json rows = ordered_json::array();
    for (const RooflineRow& row : roofline.rows)
        rows.push_back({
            {"kernel", row.kernel},
            {"flops_per_item", row.flops_per_item},
            {"bytes_per_item", row.bytes_per_item},
            {"flops_per_byte", json_number(row.flops_per_byte())},
            {"flops_per_s", row.flops_per_s},
            {"bytes_per_s", row.bytes_per_s},
            {"share_of_roof", roofline.share_of_roof(row)},
            {"counted_on", row.counted_on},
            {"same_tracing", row.same_tracing},
        });
    return {
        {"peak_flops_per_s", roofline.peaks.flops_per_s},
        {"peak_bytes_per_s", roofline.peaks.bytes_per_s},
        {"vector_width", roofline.peaks.vector_width},
        {"counted_with", roofline.counted_with},
        {"kernels", rows},
    };
}

}  // namespace wavepath
