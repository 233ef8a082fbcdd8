// What must not matter: the size of a scene, where it lies, and how many samples were summed.
#include "commands/stress/situation.h"
#include "scene/shapes.h"

namespace wavepath {

namespace {

constexpr double form_factor = 0.2394564705;  // of a unit square from 1 below its centre

Situation lit_square(Effort effort, const std::string& method, double scale, const Vec3d& shift) {
    Situation s;
    s.method = method;
    s.scene = scene_named("square light");
    add_square(s.scene, lambert(grey(0), grey(1)), {0, 0, 1}, {0, 0, -1}, 1);
    add_square(s.scene, lambert(grey(1)), {0, 0, 0}, {0, 0, 1}, 0.02);
    Camera camera = close_up({0, 0, 0}, {0, 0, 1}, 0.2, 2e-3);
    transform(s.scene, camera, scale, shift);
    s.settings = sampled_once(effort, method, camera);
    s.truth = form_factor;
    return s;
}

// Walls that emit a tenth: a plain sum of floats is off by a hundredth after 10^6.
Situation summed(double samples) {
    Situation s;
    s.family = "A constant, summed";
    s.abscissa = "samples a pixel";
    s.x = samples;
    s.method = "film";
    s.scene = scene_named(s.family);
    add_box(s.scene, lambert(grey(0), grey(0.1F)), {-1, -1, -1}, {1, 1, 1}, Facing::inward);
    s.settings = sampled_once(Effort::quick, "path", perspective({0, 0, 0}, {1, 0.2, 0.3}, 1));
    s.settings.width = s.settings.height = 4;
    s.settings.samples = static_cast<uint64_t>(samples);
    s.truth = 0.1F;
    s.truth_error = 1e-6;
    s.relative_variance = 0;
    return s;
}

}  // namespace

std::vector<Situation> place_situations(Effort effort) {
    std::vector<Situation> situations;
    for (const char* method : {"path", "direct", "mis"}) {
        for (const double scale : {1e-4, 1e-2, 1.0, 1e2, 1e4}) {
            Situation& s = situations.emplace_back(lit_square(effort, method, scale, {0, 0, 0}));
            s.family = "A lit square of any size";
            s.abscissa = "scale";
            s.x = scale;
        }
        for (const double shift : {1.0, 1e2, 1e4, 1e6}) {
            Situation& s =
                situations.emplace_back(lit_square(effort, method, 1, {shift, -shift, shift}));
            s.family = "A lit square far from the origin";
            s.abscissa = "distance from the origin [edges]";
            s.x = shift;
        }
    }
    const double most = effort == Effort::quick ? 1e6 : 1e7;
    for (double samples = 1; samples <= most; samples *= 100) situations.push_back(summed(samples));
    return situations;
}

}  // namespace wavepath
