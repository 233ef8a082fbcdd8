// The kernel files as the build embedded them (cmake/embed_kernels.cmake writes the definition).
#pragma once

#include <span>
#include <string_view>

namespace wavepath {

// A file's text is that of its chunks, in order; an empty file has none.
struct EmbeddedChunk {
    std::string_view file;  // relative to kernels/, e.g. "stages/intersect.cl"
    std::string_view text;
};

std::span<const EmbeddedChunk> embedded_chunks();

}  // namespace wavepath
