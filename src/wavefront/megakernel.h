// The chain as one kernel, which `wavepath profile --against megakernel` compares with it.
#pragma once

#include "wavefront/features.h"

#include <string>

namespace wavepath {

// The text of `kernel void megakernel`, to stand behind `source`, which holds the stages of these
// features. A work-item takes its slot through the stages, in the order of the chain, until the
// slot has no work left. Its parameters are those of all stages together.
std::string megakernel_text(const Features& features, const std::string& source);

}  // namespace wavepath
