#pragma once

namespace wavepath {

// Of the source, as git names it; "-dirty" where files differ from it (cmake/revision.cmake).
extern const char* const revision;

}  // namespace wavepath
