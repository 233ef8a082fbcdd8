// What a window needs besides its paths: what is to be rendered, and the sums of its units of work.
#pragma once

#include "wavefront/kernel_buffers.h"

namespace wavepath {

struct WindowBuffers {
    WindowBuffers() = default;  // holds nothing
    // `max_cells`: the most units of work of one window.
    WindowBuffers(const Device& device, uint64_t max_cells);

    DeviceArray<RenderParams> settings;  // one
    DeviceArray<PlanRow> plan;           // a row a pass
    DeviceArray<cl_float> cells;         // CELL_FLOATS a unit
    DeviceArray<cl_uint> cell_flags;     // one a unit

    std::size_t bytes() const;
    // Under the names that kernels use.
    void name(KernelBuffers& buffers) const;
};

}  // namespace wavepath
