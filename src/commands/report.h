// What `--json` writes: everything a render did, for scripts (schema in docs/report.md).
#pragma once

#include "commands/render_job.h"
#include "wavefront/renderer.h"

#include <nlohmann/json.hpp>
#include <string>

namespace wavepath {

inline constexpr int report_schema = 1;

// Version, revision and compiler.
std::string build_text();

// What was asked for; with the same version it makes the same picture.
nlohmann::ordered_json settings_report(const RenderJob& job);

// Non-finite numbers become null.
nlohmann::ordered_json render_report(
    const Device& device, const RenderJob& job, const RenderResult& result);

// Kernel rows with shares and rates, and the time outside kernels.
nlohmann::ordered_json profile_report(const RenderResult& result);

}  // namespace wavepath
