// A finished picture with its layers, as it is written to files.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace wavepath {

struct Image {
    uint32_t width = 0;
    uint32_t height = 0;
    // Planes by EXR channel name ("R", "albedo.R", "normal.X", "depth.Z", "variance.R" ...), row by
    // row from the top.
    std::map<std::string, std::vector<float>> channels;
    // Header attributes ("wavepath.seed" -> "1").
    std::map<std::string, std::string> metadata;
};

}  // namespace wavepath
