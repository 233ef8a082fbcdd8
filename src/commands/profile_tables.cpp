#include "commands/profile_tables.h"

#include <fmt/format.h>

#include <algorithm>

namespace wavepath {

Table kernel_table(const RenderResult& result) {
    std::vector<ProfileRow> rows = result.profile;
    std::ranges::sort(rows, std::greater{}, &ProfileRow::seconds);
    Table table{{"kernel", "launches", "items", "ms", "share", "ns/item", "Mitems/s"}, {}};
    double kernels = 0;
    const auto share = [&](double seconds) {
        return fmt::format("{:.1f}%", 100 * seconds / result.times.render);
    };
    for (const ProfileRow& row : rows) {
        kernels += row.seconds;
        const auto items = static_cast<double>(std::max<uint64_t>(row.items, 1));
        table.rows.push_back(
            {row.name, std::to_string(row.launches), std::to_string(row.items),
             fmt::format("{:.2f}", 1e3 * row.seconds), share(row.seconds),
             fmt::format("{:.2f}", 1e9 * row.seconds / items),
             fmt::format("{:.2f}", row.seconds > 0 ? 1e-6 * items / row.seconds : 0)});
    }
    const double outside = result.times.render - kernels;
    table.rows.push_back(
        {"outside kernels", "", "", fmt::format("{:.2f}", 1e3 * outside), share(outside), "", ""});
    return table;
}

Table roofline_table(const Roofline& roofline) {
    Table table{
        {"kernel", "flop/item", "B/item", "flop/B", "GFLOP/s", "GB/s", "of the roof", "counted on"},
        {}};
    for (const RooflineRow& row : roofline.rows)
        table.rows.push_back(
            {row.kernel, fmt::format("{:.1f}", row.flops_per_item),
             fmt::format("{:.1f}", row.bytes_per_item), fmt::format("{:.2f}", row.flops_per_byte()),
             fmt::format("{:.2f}", 1e-9 * row.flops_per_s),
             fmt::format("{:.2f}", 1e-9 * row.bytes_per_s),
             fmt::format("{:.1f}%", 100 * roofline.share_of_roof(row)),
             row.counted_on + (row.same_tracing ? "" : ": not as here")});
    return table;
}

Table build_table(const BuildReport& build) {
    Table table{{"kernel", "private B/item", "local B/group", "preferred multiple"}, {}};
    for (const KernelBuild& kernel : build.kernels)
        table.rows.push_back(
            {kernel.name, std::to_string(kernel.private_bytes), std::to_string(kernel.local_bytes),
             std::to_string(kernel.preferred_multiple)});
    return table;
}

std::vector<uint64_t> rays_by_depth(const RayCounts& rays) {
    uint64_t alive = 0;
    for (const uint64_t n : rays.path_lengths) alive += n;
    std::vector<uint64_t> counts;
    for (const uint64_t ended : rays.path_lengths) {
        if (alive == 0) break;
        counts.push_back(alive);
        alive -= ended;
    }
    return counts;
}

Table depth_table(const RayCounts& rays) {
    Table table{{"depth", "closest-hit rays"}, {}};
    const std::vector<uint64_t> counts = rays_by_depth(rays);
    for (std::size_t depth = 0; depth < counts.size(); ++depth)
        table.rows.push_back(
            {fmt::format("{}{}", depth, depth + 1 == rays.path_lengths.size() ? "+" : ""),
             std::to_string(counts[depth])});
    return table;
}

std::string peaks_sentence(const Roofline& roofline) {
    return fmt::format(
        "This device gives {:.1f} GB/s (triad) and {:.1f} GFLOP/s (fused multiply-adds, {} wide), "
        "measured just now; operations and bytes an item were counted with {} on small scenes.",
        1e-9 * roofline.peaks.bytes_per_s, 1e-9 * roofline.peaks.flops_per_s,
        roofline.peaks.vector_width, roofline.counted_with);
}

std::string build_sentence(const BuildReport& build) {
    return fmt::format(
        "The program took {:.0f} ms to build ({}){}.", 1e3 * build.seconds,
        build.from_cache ? "from our cache" : "from source, or from the driver's cache",
        build.binary_bytes ? fmt::format("; its binary has {} bytes", *build.binary_bytes) : "");
}

std::string text_of(const Table& table) {
    std::vector<std::size_t> widths;
    for (const std::string& column : table.columns) widths.push_back(column.size());
    for (const auto& row : table.rows)
        for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
    std::string text;
    const auto add = [&](const std::vector<std::string>& row) {
        text += fmt::format("{:<{}}", row.front(), widths.front());
        for (std::size_t i = 1; i < row.size(); ++i)
            text += fmt::format("  {:>{}}", row[i], widths[i]);
        text += '\n';
    };
    add(table.columns);
    for (const auto& row : table.rows) add(row);
    return text;
}

}  // namespace wavepath
