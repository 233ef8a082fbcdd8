// Sample models and malformed files, which stand in a folder beside the checkout, or in the one
// that WAVEPATH_ASSETS names.
#pragma once

#include "build_paths.h"

#include <cstdlib>
#include <filesystem>

namespace wavepath {

// The folder, or an empty path.
inline std::filesystem::path asset_folder() {
    namespace fs = std::filesystem;
    const char* named = std::getenv("WAVEPATH_ASSETS");
    const fs::path folder =
        named ? fs::path(named) : fs::path(WAVEPATH_SOURCE_DIR) / ".." / "shared" / "assets";
    return fs::is_directory(folder) ? folder : fs::path();
}

}  // namespace wavepath
