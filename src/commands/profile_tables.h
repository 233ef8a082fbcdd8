// The tables of `wavepath profile`, for the terminal and the page alike.
#pragma once

#include "commands/roofline.h"
#include "page/page.h"

#include <string>

namespace wavepath {

// Time by kernel, most first, and the time outside kernels.
Table kernel_table(const RenderResult& result);

Table roofline_table(const Roofline& roofline);

// What the driver says of every kernel it built.
Table build_table(const BuildReport& build);

// Closest-hit rays by the number of scatterings before them.
Table depth_table(const RayCounts& rays);

// Rays traced after so many scatterings, k = 0, 1, ...; the last: and more.
std::vector<uint64_t> rays_by_depth(const RayCounts& rays);

// One sentence each, with units.
std::string peaks_sentence(const Roofline& roofline);
std::string build_sentence(const BuildReport& build);

// For a terminal: columns apart, the first to the left and others to the right.
std::string text_of(const Table& table);

}  // namespace wavepath
