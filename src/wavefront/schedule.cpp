#include "wavefront/schedule.h"

#include <algorithm>

namespace wavepath {

std::vector<Window> Schedule::next(const std::vector<FilmBand>& bands, double elapsed) {
    const double wanted = seconds_ > 0 ? std::clamp(seconds_ - elapsed, 0.0, 1.0) : 1.0;
    const double passes = rate_ > 0 ? wanted * rate_ : 1;
    const uint64_t fit = std::clamp<uint64_t>(max_cells_ / pixels_, 1, SamplePlan::most_rows);
    const std::vector<PlanRow> rows =
        plan_.take(std::min(fit, std::max(least_passes_, static_cast<uint64_t>(passes))));
    passes_ = rows.size();
    std::vector<Window> windows;
    windows.reserve(bands.size());
    for (const FilmBand& band : bands) windows.push_back({band.first_pixel, band.pixels, rows});
    return windows;
}

}  // namespace wavepath
