// A ball of glass that absorbs, in a uniform environment: L = R + (1 - R)^2 t / (1 - R t), t along
// the chord inside, R of one interface; exact at every distance b from the axis.
#include "support/media.h"
#include "support/rendering.h"

namespace wavepath {
namespace {

constexpr const char* channels[] = {"R", "G", "B"};

// Not at b = 0.99, where light meets the ball at cos 0.14: facets turn it by 5 % of that, and a
// footprint that averages over several of them reaches the rim.
TEST(DielectricBall, AbsorbsAtEveryDistanceFromItsAxis) {
    constexpr int subdivisions = 7;
    constexpr double distances[] = {0, 0.3, 0.6, 0.9};
    const struct {
        double ior, sigma;
        double truth[4];
    } cases[] = {
        {1.5, 0.25, {.6128773634, .6188638751, .6384859186, .6837537397}},
        {1.33, 1, {.1503733535, .1573614524, .1836671108, .2782285957}}};
    for (const auto& [ior, sigma, truth] : cases) {
        Scene scene = scene_named("ball");
        scene.environment = constant_environment(1);
        add_icosphere(scene, glass(ior, medium_of(sigma, 0)), {0, 0, 0}, 1, subdivisions);
        for (std::size_t k = 0; k < std::size(distances); ++k) {
            const double b = distances[k];
            // at b = 0.9 the footprint's curvature and the facets' angles add as much again
            const Strictness strictness{
                .tests = 8, .truth_error = (b > 0.6 ? 30 : 2) * icosphere_sagitta(subdivisions)};
            const RenderResult result = render_for(
                strictness, scene,
                square_settings("mis", orthographic({b, 0, 2}, {b, 0, 0}, 0.01), 32, 64));
            // facets differ from one another: pixels have means of their own
            EXPECT_TRUE(has_mean(image_mean(result), truth[k], strictness))
                << "n " << ior << ", b " << b;
        }
    }
}

// n = 1.5 over the square abs(x), abs(y) < 0.6, by quadrature, for sigma_a R = 0.25, 0.5 and 1.
// Near the rim facets are no sphere: they turn some rays inside beyond the critical angle, where
// they stay and are absorbed, which takes 0.1 % off the whole disc.
TEST(DielectricBall, AbsorbsOverItsMiddle) {
    constexpr double truth[] = {.6299092719, .4053282999, .1825763998};
    constexpr int subdivisions = 6;
    Medium medium;
    medium.sigma_a = {0.25F, 0.5F, 1};
    Scene scene = scene_named("ball");
    scene.environment = constant_environment(1);
    add_icosphere(scene, glass(1.5, medium), {0, 0, 0}, 1, subdivisions);
    const double truth_error = 2 * icosphere_sagitta(subdivisions);
    // blue is half of it what few paths reflect: 1 % will do there
    const Strictness strictness[] = {
        {.tests = 3, .truth_error = truth_error},
        {.tests = 3, .truth_error = truth_error},
        {.bias = 0.01, .tests = 3, .truth_error = truth_error}};
    const RenderResult result = render_for(
        strictness[2], scene,
        square_settings("mis", orthographic({0, 0, 2}, {0, 0, 0}, 1.2), 64, 64), "B");
    for (std::size_t c = 0; c < 3; ++c)
        EXPECT_TRUE(has_mean(image_mean(result, channels[c]), truth[c], strictness[c]))
            << channels[c];
}

}  // namespace
}  // namespace wavepath
