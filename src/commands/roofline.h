// How near every kernel of a render comes to what its device can do [Williams 2009].
#pragma once

#include "device/peaks.h"
#include "wavefront/renderer.h"

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace wavepath {

// Operations and bytes an item are those of kernels/counts.json, which scripts/kernel_counts.py
// counts on a small render; bytes are what instructions ask for, be it of a cache.
struct RooflineRow {
    std::string kernel;
    double flops_per_item = 0, bytes_per_item = 0;
    double flops_per_s = 0, bytes_per_s = 0;
    std::string counted_on;    // the scene, and the way of tracing where there are several
    bool same_tracing = true;  // as this render's; always, where there is but one
    double seconds = 0;        // of the render

    double flops_per_byte() const { return flops_per_item / bytes_per_item; }
};

struct Roofline {
    Peaks peaks;
    std::string counted_with;       // program and version
    std::vector<RooflineRow> rows;  // of kernels that ran, by time

    // Of what the device could do at the row's operations a byte; above 1 where caches serve.
    double share_of_roof(const RooflineRow& row) const;
};

// Where the driver returns no times there are no rows. Throws Error where WAVEPATH_KERNELS names a
// folder without counts.json.
Roofline roofline_of(const RenderResult& result, const Peaks& peaks);

nlohmann::ordered_json roofline_report(const Roofline& roofline);

}  // namespace wavepath
