// A white metal plate in a sky of radiance 1: its radiance is the directional albedo of GGX.
#include "commands/stress/situation.h"
#include "scene/shapes.h"

#include <fmt/format.h>

#include <cmath>

namespace wavepath {

namespace {

// By quadrature: the albedo of single scattering [Heitz 2014], and relative variances of one sample
// by cosine and by visible normals [Heitz 2018].
struct Known {
    double alpha, albedo, cosine, visible;
};
constexpr double slant = 0.1;  // wo.n
const Known at_slant[] = {
    {0.1, 0.883455, 424.9, 0.06229},
    {0.25, 0.891622, 17.02, 0.05652},
    {0.5, 0.860105, 1.226, 0.08163},
    {1, 0.760210, 0.2881, 0.1636}};
const Known upright[] = {
    {0.1, 0.988304, 7.708, 0.01056},
    {0.25, 0.915812, 0.8199, 0.07174},
    {0.5, 0.687849, 0.03702, 0.3184},
    {1, 0.306853, 0.02565, 1.415}};

Situation of_plate(Effort effort, const Known& known, double mu, const std::string& method) {
    Situation s;
    s.family = fmt::format("A rough metal in a sky, seen under a cosine of {}", mu);
    s.abscissa = "alpha of GGX";
    s.x = known.alpha;
    s.method = method;
    s.scene = scene_named(s.family);
    s.scene.environment = constant_environment(1);
    add_square(
        s.scene, metal(grey(1), static_cast<float>(std::sqrt(known.alpha))), {0, 0, 0}, {0, 0, 1},
        1);
    const double sine = std::sqrt(1 - mu * mu);
    s.settings = sampled_once(effort, method, orthographic({sine, 0, mu}, {0, 0, 0}, 0.01));
    s.truth = known.albedo;
    s.truth_error = 1e-5;
    s.relative_variance = method == "path" ? known.cosine : known.visible;
    if (*s.relative_variance > 25) s.expected = Verdict::noisy;
    return s;
}

}  // namespace

std::vector<Situation> lobe_situations(Effort effort) {
    std::vector<Situation> situations;
    for (const char* method : {"path", "bsdf", "mis"}) {
        for (const Known& known : upright) situations.push_back(of_plate(effort, known, 1, method));
        for (const Known& known : at_slant)
            situations.push_back(of_plate(effort, known, slant, method));
    }
    return situations;
}

}  // namespace wavepath
