// A clear pane in a white sky, order by order, and of coloured glass. Each of its two interfaces
// reflects R: 1 - (1 - R) R^(D - 1) has left it after D >= 1 scatterings.
#include "support/media.h"
#include "support/rendering.h"

#include <cmath>

namespace wavepath {
namespace {

constexpr double ior = 1.5;

// Unpolarised mean for a ray that arrives from air under cos = mu.
double reflectance(double mu) {
    const double beyond = std::sqrt(1 - (1 - mu * mu) / (ior * ior));
    const double s = (mu - ior * beyond) / (mu + ior * beyond);
    const double p = (ior * mu - beyond) / (ior * mu + beyond);
    return 0.5 * (s * s + p * p);
}

Scene pane(const Rgb& base_color) {
    Scene scene = scene_named("pane");
    scene.environment = constant_environment(1);
    Material material = glass(ior);
    material.base_color = base_color;
    add_box(scene, material, {-40, -40, -1}, {40, 40, 0}, Facing::outward);
    return scene;
}

// Grazing, where what is reflected is most of the first orders and so not noisy.
TEST(Dielectric, PaneHasTheOrdersOfTheDepthAsked) {
    constexpr double mu = 0.2;
    const double r = reflectance(mu);
    const Scene scene = pane(grey(1));
    RenderSettings settings = square_settings("path", along(mu), 16, 256);
    settings.termination = {TerminationKind::depth, 0, 1};
    EXPECT_EQ(shared_mean(render_scene(scene, settings)).mean, 0);
    const Strictness strictness{.tests = 6, .truth_error = 1e-6};
    for (const char* method : {"path", "mis"})
        for (const uint32_t depth : {1U, 2U, 3U}) {
            settings.method = method_named(method);
            settings.termination.depth = depth;
            EXPECT_TRUE(has_mean(
                shared_mean(render_for(strictness, scene, settings)),
                1 - (1 - r) * std::pow(r, depth - 1), strictness))
                << method << ", depth " << depth;
        }
}

// Coloured glass tints what enters and what leaves, and nothing that it reflects, inside or out:
// with all orders R + (1 - R) c^2.
TEST(Dielectric, PaneTintsWhatPasses) {
    constexpr Rgb color{0.5F, 0.8F, 0};
    const Scene scene = pane(color);
    const Strictness strictness{.tests = 6, .truth_error = 1e-6};
    for (const double mu : {0.2, 0.3}) {
        const double r = reflectance(mu);
        // what black glass reflects is the noisiest
        const RenderResult result =
            render_for(strictness, scene, square_settings("mis", along(mu), 16, 256), "B");
        const char* channels[] = {"R", "G", "B"};
        for (std::size_t c = 0; c < 3; ++c)
            EXPECT_TRUE(has_mean(
                shared_mean(result, channels[c]), r + (1 - r) * std::pow(color[c], 2), strictness))
                << "mu " << mu << ", " << channels[c];
    }
}

}  // namespace
}  // namespace wavepath
