// The folders that pages are written into.
#pragma once

#include <filesystem>

namespace wavepath {

// Makes the folder where it is not there, and throws Error unless `file` can be written in it: to
// be asked before hours of rendering.
void make_output_folder(const std::filesystem::path& folder, const std::filesystem::path& file);

}  // namespace wavepath
