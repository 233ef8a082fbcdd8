// How far a render has come, for people.
#pragma once

#include "wavefront/renderer.h"

#include <string>

namespace wavepath {

// Two figures, or "unknown" where a picture has too few batches to tell.
std::string relative_error_text(double relative_error);

class Progress {
  public:
    Progress(const RenderSettings& settings, bool quiet);

    // On a terminal rewrites one line twice a second; elsewhere prints a line every ten seconds.
    void show(const RenderProgress& state);
    void finish();  // ends the line

  private:
    std::string line(const RenderProgress& state) const;

    const RenderSettings& settings_;
    bool quiet_;
    bool terminal_;
    bool shown_ = false;
    double next_ = 0;  // [s] of rendering
};

}  // namespace wavepath
