// The command behind a picture, from what its EXR says of itself.
#pragma once

#include "image/image.h"

#include <string>

namespace wavepath {

// The line of a shell that renders this picture again, but for --device, --pool and the place of
// relative files; empty for a picture of another program.
std::string render_command(const Image& image);

// Whether two pictures were made by one build and one set of options but for seed and device, so
// that each could as well be the other.
bool are_exchangeable(const Image& a, const Image& b);

}  // namespace wavepath
