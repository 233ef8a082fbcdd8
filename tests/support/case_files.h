// Small files that failed in this program or in others, which stand beside the sample models.
#pragma once

#include "support/sample_files.h"

namespace wavepath {

// The folder `name` of them, or an empty path.
inline std::filesystem::path case_folder(const std::string& name) {
    const std::filesystem::path folder = asset_folder().parent_path() / "cases" / name;
    return std::filesystem::is_directory(folder) ? folder : std::filesystem::path();
}

}  // namespace wavepath
