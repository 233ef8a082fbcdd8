// One scattering in a medium, by every way to choose where and whereto.
#include "commands/stress/situation.h"
#include "scene/shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace wavepath {

namespace {

void scatter_once(Situation& s, Distances distances) {
    s.settings.termination = {TerminationKind::depth, 1, 1};
    s.settings.method.distances = distances;
}

// A needle of a medium along the view, of length 1, before a black square in a sky of radiance 1:
// what scatters leaves by the side and finds the sky for certain, so that nothing varies but how it
// was made to scatter.
Situation on_needle(Effort effort, const Medium& medium) {
    constexpr double half = 5e-5;
    Situation s;
    s.scene = scene_named("needle");
    s.scene.environment = constant_environment(1);
    add_box(s.scene, boundary_of(medium), {-half, -half, -1}, {half, half, 0}, Facing::outward);
    add_square(s.scene, lambert(grey(0)), {0, 0, -1.00001}, {0, 0, 1}, 4 * half);
    s.settings = sampled_once(effort, "path", orthographic({0, 0, 0.5}, {0, 0, 0}, 1e-6));
    s.truth = 1 - std::exp(-double{medium.sigma_s[0]});
    // The needle is not quite thin: a share scatters once more, most of what goes on forwards.
    s.truth_error = std::max(2e-3, 2e-4 / (1 - double{medium.anisotropy}));
    return s;
}

Situation by_thickness(Effort effort, double tau, Distances distances) {
    Situation s = on_needle(effort, medium_of(tau, 1, 0.5));
    s.family = "A needle of a medium before a black wall, in a sky";
    s.abscissa = "optical thickness";
    s.x = tau;
    s.method = "--distance " + name_of(distances);
    scatter_once(s, distances);
    s.relative_variance = 0;
    if (distances == Distances::uniform) s.relative_variance = tau / 2 / std::tanh(tau / 2) - 1;
    if (distances == Distances::exponential) s.relative_variance = 1 / std::expm1(tau);
    if (*s.relative_variance > 25) s.expected = Verdict::noisy;
    return s;
}

Situation by_anisotropy(Effort effort, double g, bool phase) {
    constexpr double tau = 1e-3;
    Situation s = on_needle(effort, medium_of(tau, 1, g));
    s.family = "A thin needle of a medium that scatters forwards";
    s.abscissa = "1 - g of Henyey and Greenstein";
    s.x = 1 - g;
    s.method = phase ? "--direction phase" : "--direction uniform";
    scatter_once(s, Distances::truncated);
    s.settings.method.phase_directions = phase;
    s.relative_variance = phase ? 0 : (1 + g * g) / std::pow(1 - g * g, 2) - 1;
    if (*s.relative_variance > 25) s.expected = Verdict::noisy;
    return s;
}

// The sun shines straight through a plate: it reaches every stop and leaves it over exp(-tau) in
// all. What is known of stops that are alike for all of them: no variance.
Situation before_sun(Effort effort, double tau, Distances distances) {
    Situation s;
    s.family = "A plate of a medium before the sun";
    s.abscissa = "optical thickness";
    s.x = tau;
    s.method = "--distance " + name_of(distances);
    s.scene = scene_named(s.family);
    const double half = 400 / tau;
    add_box(
        s.scene, boundary_of(medium_of(tau, 1)), {-half, -half, -1}, {half, half, 0},
        Facing::outward);
    PunctualLight sun;
    sun.kind = LightKind::directional;
    sun.direction = {0, 0, 1};
    s.scene.lights.push_back(sun);
    s.settings = sampled_once(effort, "mis", orthographic({0.1, 0.03, 2}, {0.1, 0.03, 0}, 0.01));
    scatter_once(s, distances);
    s.truth = tau * std::exp(-tau) / (4 * std::numbers::pi);
    s.relative_variance = 0;
    if (distances != Distances::uniform) {
        // A truncated exponential never leaves the plate, an exponential one may.
        const double inside = distances == Distances::truncated ? -std::expm1(-tau) : 1;
        s.relative_variance = inside * std::expm1(tau) / (tau * tau) - 1;
        if (*s.relative_variance > 25) s.expected = Verdict::noisy;
    }
    return s;
}

}  // namespace

std::vector<Situation> medium_situations(Effort effort) {
    std::vector<Situation> situations;
    for (const Distances distances :
         {Distances::exponential, Distances::truncated, Distances::uniform}) {
        for (const double tau : {0.01, 0.1, 1.0, 10.0})
            situations.push_back(by_thickness(effort, tau, distances));
        for (const double tau : {1.0, 5.0, 10.0})
            situations.push_back(before_sun(effort, tau, distances));
    }
    situations.push_back(by_thickness(effort, 100, Distances::uniform));
    for (const bool phase : {true, false})
        for (const double g : {0.5, 0.75, 0.9, 0.99})
            situations.push_back(by_anisotropy(effort, g, phase));
    return situations;
}

}  // namespace wavepath
