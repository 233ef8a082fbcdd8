#include "commands/stress/situation.h"

namespace wavepath {

std::string name_of(Verdict verdict) {
    switch (verdict) {
        case Verdict::sound:
            return "sound";
        case Verdict::noisy:
            return "noisy";
        case Verdict::infinite_variance:
            return "infinite variance";
        case Verdict::biased:
            return "biased";
    }
    return "";
}

RenderSettings sampled_once(Effort effort, const std::string& method, const Camera& camera) {
    RenderSettings settings;
    settings.width = settings.height = effort == Effort::quick ? 256 : 1024;
    settings.camera = camera;
    settings.samples = 1;
    settings.sobol = false;
    settings.method = method_named(method);
    return settings;
}

}  // namespace wavepath
