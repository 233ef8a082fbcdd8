// What `--json` writes: everything a render did, for scripts (schema in docs/report.md).
#pragma once

#include "commands/render_options.h"
#include "wavefront/renderer.h"

#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace wavepath {

inline constexpr int report_schema = 1;

// Non-finite numbers become null.
nlohmann::ordered_json render_report(
    const Device& device, const RenderJob& job, const RenderResult& result);

// How media were sampled, as the command line spells it: `distance`, `direction`. Empty where the
// scene has no media.
std::map<std::string, std::string> media_settings(const RenderJob& job);

// Kernel rows with shares and rates, and the time outside kernels.
nlohmann::ordered_json profile_report(const RenderResult& result);

}  // namespace wavepath
