// What `--trace` writes: the timeline of a render, for Perfetto and chrome://tracing.
#pragma once

#include "wavefront/renderer.h"

#include <nlohmann/json.hpp>
#include <string>

namespace wavepath {

// In the Trace Event Format [Google 2016]: a row (tid) a kernel and one for the host, of complete
// events in microseconds; counters of slots with work and of rays in flight. `result` has to hold
// a timeline.
nlohmann::ordered_json trace_of(const std::string& scene, const RenderResult& result);

}  // namespace wavepath
