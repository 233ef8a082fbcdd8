// What `wavepath profile -o DIR` draws.
#pragma once

#include "commands/roofline.h"

#include <filesystem>
#include <string>

namespace wavepath {

// The tables of the terminal, and charts: roofline, time by kernel, slots with work over time, rays
// by depth. `title`: what was rendered, how, and where. `result` has to hold a timeline. Throws
// Error where the page cannot be drawn or written.
void write_profile_page(
    const std::filesystem::path& path,
    const std::string& title,
    const RenderResult& result,
    const Roofline& roofline);

}  // namespace wavepath
