// What is said of a picture whose samples are not what they should be.
#pragma once

#include "wavefront/renderer.h"

#include <string>

namespace wavepath {

// Adds to the result's warnings what the samples themselves show to be wrong. `gains_energy`: some
// layer may.
void warn_of_samples(
    RenderResult& result, const std::string& scene, uint64_t pixels, bool gains_energy);

}  // namespace wavepath
