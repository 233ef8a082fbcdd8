// A diffuse receiver near, far from, and touching a square light.
#include "commands/stress/situation.h"
#include "scene/shapes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace wavepath {

namespace {

// Form factor from a point below the centre of a unit square, parallel to it [Howell 2011].
double form_factor(double height) {
    const double x = 0.5 / height;
    const double s = x / std::sqrt(1 + x * x);
    return 4 / std::numbers::pi * s * std::atan(s);
}

// Relative variances of one sample of the whole light by area, and of both techniques by the power
// heuristic, by quadrature.
struct Predicted {
    double direct, mis;
};
const std::map<double, Predicted> predicted_by_height{
    {1e-3, {106103, 0.001961}},  {1e-2, {1060.73, 0.018937}},    {0.1, {10.3151, 0.139377}},
    {1, {0.0303545, 0.0336761}}, {10, {4.42339e-6, 4.45495e-6}}, {100, {4.444e-10, 4.44e-10}}};

Situation under_light(Effort effort, double height, const std::string& method) {
    Situation s;
    s.family = "A receiver below the centre of a square light";
    s.abscissa = "height of the light [edges]";
    s.x = height;
    s.method = method;
    const double near = std::min(height, 1.0);
    const Vec3d point{0, 0, 1 - height};
    s.scene = scene_named(s.family);
    add_square(s.scene, lambert(grey(0), grey(1)), {0, 0, 1}, {0, 0, -1}, 1);
    add_square(s.scene, lambert(grey(1)), point, {0, 0, 1}, 0.02 * near);
    s.settings = sampled_once(effort, method, close_up(point, {0, 0, 1}, 0.2 * near, 2e-3 * near));
    // Both triangles alike, as predicted.
    s.settings.method.light_choice = LightChoice::area;
    s.truth = form_factor(height);
    const Predicted& predicted = predicted_by_height.at(height);
    if (method == "direct")
        s.relative_variance = predicted.direct;
    else if (method == "mis")
        s.relative_variance = predicted.mis;
    else
        s.relative_variance = (1 - s.truth) / s.truth;
    if (*s.relative_variance > 25) s.expected = Verdict::noisy;
    return s;
}

// Of the line of a wall from the middle of the light's edge, which it touches, one edge down, by
// quadrature. The samples of `direct` have tail index 3/2.
constexpr double wall_factor = 0.22348730;

Situation beside_light(Effort effort, const std::string& method) {
    Situation s;
    s.family = "A wall that a light touches";
    s.abscissa = "strip of the wall, down to [edges]";
    s.x = 1;
    s.method = method;
    s.scene = scene_named(s.family);
    add_quad(s.scene, lambert(grey(1)), {0, -0.01, 0}, {0, 0.02, 0}, {0, 0, 1});
    add_quad(s.scene, lambert(grey(0), grey(1)), {0, -0.5, 1}, {0, 1, 0}, {1, 0, 0});
    s.settings = sampled_once(effort, method, orthographic({0.1, 0, 0.5}, {0, 0, 0.5}, 1));
    // 2^20 samples, to see the tail: up is y, along the light's edge, and the picture as flat.
    s.settings.width = 1U << 15U;
    s.settings.height = 1U << 5U;
    s.settings.camera.y_mag = 0.5 * s.settings.height / s.settings.width;
    s.truth = wall_factor;
    s.truth_error = 1e-4;  // the strip has a width
    if (method == "path" || method == "bsdf") s.relative_variance = (1 - s.truth) / s.truth;
    if (method == "direct") s.expected = Verdict::infinite_variance;
    return s;
}

}  // namespace

std::vector<Situation> light_situations(Effort effort) {
    std::vector<Situation> situations;
    for (const char* method : {"path", "direct", "bsdf", "mis"}) {
        for (const auto& [height, predicted] : predicted_by_height)
            situations.push_back(under_light(effort, height, method));
        situations.push_back(beside_light(effort, method));
    }
    return situations;
}

}  // namespace wavepath
