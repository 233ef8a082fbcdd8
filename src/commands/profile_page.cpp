#include "commands/profile_page.h"

#include "commands/profile_tables.h"

namespace wavepath {

namespace {

constexpr std::size_t named_kernels = 6;  // on the roofline; the palette has a seventh, grey

Curve roof(const Roofline& roofline, double lowest, double highest) {
    const double ridge = roofline.peaks.flops_per_s / roofline.peaks.bytes_per_s;
    Curve curve{"what the device can do", {lowest, ridge, std::max(highest, 2 * ridge)}, {}};
    for (const double x : curve.x) curve.y.push_back(1e-9 * roofline.peaks.roof(x));
    curve.mark = Mark::dashed_line;
    curve.color = static_cast<int>(named_kernels);
    return curve;
}

// Kernels without a floating-point operation stand nowhere on it.
Chart roofline_chart(const Roofline& roofline) {
    Chart chart{"Roofline", "operations a byte [flop/B]", "rate [GFLOP/s]", true, true, {}, {}};
    Curve others{"the other kernels", {}, {}};
    others.mark = Mark::points;
    others.color = static_cast<int>(named_kernels);
    double lowest = 0.1;
    double highest = 1;
    for (const RooflineRow& row : roofline.rows) {
        if (row.flops_per_item == 0) continue;
        const double x = row.flops_per_byte();
        const double y = 1e-9 * row.flops_per_s;
        lowest = std::min(lowest, x / 2);
        highest = std::max(highest, 2 * x);
        if (chart.curves.size() < named_kernels) {
            Curve curve{row.kernel, {x}, {y}};
            curve.mark = Mark::points;
            curve.color = static_cast<int>(chart.curves.size());
            chart.curves.push_back(curve);
        } else {
            others.x.push_back(x);
            others.y.push_back(y);
        }
    }
    chart.curves.push_back(others);
    chart.curves.push_back(roof(roofline, lowest, highest));
    return chart;
}

Chart time_chart(const RenderResult& result) {
    Chart chart{"Time by kernel", "", "time [ms]", false, false, {}, {}};
    std::vector<ProfileRow> rows = result.profile;
    std::ranges::sort(rows, std::greater{}, &ProfileRow::seconds);
    Curve curve;
    curve.mark = Mark::bars;
    for (const ProfileRow& row : rows) {
        curve.x.push_back(static_cast<double>(chart.bars.size()));
        curve.y.push_back(1e3 * row.seconds);
        chart.bars.push_back(row.name);
    }
    chart.curves.push_back(curve);
    return chart;
}

Chart slots_chart(const Timeline& timeline) {
    Chart chart{"Slots with work", "time [ms]", "slots", false, false, {}, {}};
    Curve slots{"slots with work", {}, {}};
    Curve rays{"rays in flight", {}, {}};
    slots.mark = Mark::line;
    rays.mark = Mark::dashed_line;
    rays.color = 1;
    for (const Timeline::Count& count : timeline.counts()) {
        const double time = 1e-6 * static_cast<double>(count.time);
        slots.x.push_back(time);
        slots.y.push_back(static_cast<double>(count.slots));
        rays.x.push_back(time);
        rays.y.push_back(static_cast<double>(count.rays));
    }
    chart.curves = {slots, rays};
    return chart;
}

Chart depth_chart(const RayCounts& rays) {
    Chart chart{
        "Rays by depth", "scatterings before the ray", "closest-hit rays", false, true, {}, {}};
    Curve curve;
    for (const uint64_t count : rays_by_depth(rays)) {
        curve.x.push_back(static_cast<double>(curve.x.size()));
        curve.y.push_back(static_cast<double>(count));
    }
    chart.curves.push_back(curve);
    return chart;
}

}  // namespace

void write_profile_page(
    const std::filesystem::path& path,
    const std::string& title,
    const RenderResult& result,
    const Roofline& roofline) {
    Page page(title);
    page.heading("Where the time goes");
    page.chart(time_chart(result));
    page.table(kernel_table(result));
    page.heading("How near to what the device can do");
    page.paragraph(peaks_sentence(roofline));
    page.paragraph(
        "Bytes are those that instructions ask for: a share above 100 % means that caches serve "
        "most of them.");
    page.chart(roofline_chart(roofline));
    page.table(roofline_table(roofline));
    if (result.timeline) {  // there is none where the trace cannot be written
        page.heading("How full the pool is");
        page.chart(slots_chart(*result.timeline));
        page.paragraph(
            "trace.json, beside this page, shows every launch: open it in ui.perfetto.dev.");
    }
    page.heading("How long paths are");
    page.chart(depth_chart(result.rays));
    page.table(depth_table(result.rays));
    page.heading("What the driver built");
    page.paragraph(build_sentence(result.program));
    page.table(build_table(result.program));
    page.write(path);
}

}  // namespace wavepath
