#include "wavefront/window_buffers.h"

#include "shared/path.h"
#include "wavefront/sample_plan.h"

#include <algorithm>

namespace wavepath {

WindowBuffers::WindowBuffers(const Device& device, uint64_t max_cells)
    : settings(device, 1, "parameters"),
      plan(device, std::min<uint64_t>(max_cells, SamplePlan::most_rows), "sample plan"),
      cells(device, std::size_t{CELL_FLOATS} * max_cells, "units of work"),
      cell_flags(device, max_cells, "units of work") {}

std::size_t WindowBuffers::bytes() const {
    KernelBuffers buffers;
    name(buffers);
    return buffers.bytes();
}

void WindowBuffers::name(KernelBuffers& buffers) const {
    buffers.add("settings", settings, Access::read);
    buffers.add("plan", plan, Access::read);
    buffers.add("cells", cells, Access::write);
    buffers.add("cell_flags", cell_flags, Access::write);
}

}  // namespace wavepath
