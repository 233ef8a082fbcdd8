// Balls of a medium: chords, and a sphere's integral equation for isotropic media [rho, Tm and phi
// as in its solution: albedo of the wall, radiance on the mean over the disc, mean radiance].
#include "support/media.h"
#include "support/rendering.h"

#include <cmath>
#include <numbers>

namespace wavepath {
namespace {

constexpr int subdivisions = 5;
constexpr const char* channels[] = {"R", "G", "B"};

// Chord of a sphere, averaged over its disc: 2 [1 - (1 + t) e^-t] / t^2, t = 2 sigma_a R; t = 0.1,
// 1 and 10 are the channels. And from its centre: e^-t/2 everywhere.
TEST(MediaSphere, Absorbs) {
    constexpr double thicknesses[] = {0.1, 1.0, 10.0};
    Medium medium;
    for (std::size_t c = 0; c < 3; ++c) medium.sigma_a[c] = static_cast<float>(thicknesses[c] / 2);
    Scene scene = scene_named("sphere");
    scene.environment = constant_environment(1);
    add_icosphere(scene, boundary_of(medium), {0, 0, 0}, 1, subdivisions);
    const RenderResult centre = render_scene(
        scene, square_settings("mis", perspective({0, 0, 0}, {1, 0.3, 0.2}, 1.5), 16, 4));
    // the square around the disc sees the sky, 1, in its corners
    const RenderResult disc = render_for(
        {.tests = 3}, scene, square_settings("mis", orthographic({0, 0, 2}, {0, 0, 0}, 2), 64, 64),
        "B");
    for (std::size_t c = 0; c < 3; ++c) {
        const double t = thicknesses[c];
        SCOPED_TRACE(t);
        const double truth_error = (1 + t) * 2 * icosphere_sagitta(subdivisions);
        EXPECT_NEAR(shared_mean(centre, channels[c]).mean / std::exp(-t / 2), 1, truth_error);
        const double chord = 2 * (1 - (1 + t) * std::exp(-t)) / (t * t);
        const double share = std::numbers::pi / 4;
        EXPECT_TRUE(has_mean(
            image_mean(disc, channels[c]), share * chord + 1 - share,
            {.tests = 3, .truth_error = truth_error}));
    }
}

Scene ball(double tau, const Rgb& albedos) {
    Scene scene = scene_named("ball");
    scene.environment = constant_environment(1);
    add_icosphere(scene, boundary_of(medium_of(tau, albedos)), {0, 0, 0}, 1, subdivisions);
    return scene;
}

// At a distance b from the middle of the disc; the footprint is small against what b leaves.
Camera beside(double b) {
    return orthographic({b, 0, 2}, {b, 0, 0}, 1e-2);
}

// In a sky of radiance 1, through the centre; and from the centre, any way.
TEST(MediaSphere, ShinesByItsIntegralEquation) {
    const struct {
        double tau;
        Rgb albedos;
        Camera camera;
        double truth[3];
    } cases[] = {
        {1, {0.5F, 0.9F, 0.999F}, beside(0), {.410499046, .835122040, .998174104}},
        {2,
         {0.5F, 0.9F, 0.9F},
         perspective({0, 0, 0}, {1, 0.3, 0.2}, 1),
         {.281549103, .716303202, .716303202}}};
    for (const auto& c : cases) {
        const Strictness strictness{
            .tests = 6, .truth_error = 2 * c.tau * icosphere_sagitta(subdivisions)};
        const RenderResult result = render_for(
            strictness, ball(c.tau, c.albedos), square_settings("mis", c.camera, 16, 256));
        for (std::size_t k = 0; k < 3; ++k)
            EXPECT_TRUE(has_mean(shared_mean(result, channels[k]), c.truth[k], strictness))
                << c.tau << ", " << channels[k];
    }
}

// The mean over the disc of a ball, whose corners of the picture the sky fills.
TEST(MediaSphere, ShinesByItsIntegralEquationOverItsDisc) {
    const struct {
        double tau;
        Rgb albedos;
        double truth[3];
    } rows[] = {
        {0.5, {0.5F, 0.9F, 0.9F}, {.724170686, .936018892, .936018892}},
        {1, {0.5F, 0.9F, 0.999F}, {.542257109, .878006156, .998667911}},
        {2, {0.5F, 0.9F, 0.9F}, {.348923823, .781617317, .781617317}},
        {5, {0.5F, 0.9F, 0.999F}, {.205194979, .623484582, .993389979}}};
    constexpr double share = std::numbers::pi / 4;
    for (const auto& [tau, albedos, truth] : rows) {
        const Strictness strictness{
            .tests = 10, .truth_error = 2 * tau * icosphere_sagitta(subdivisions)};
        // the part of the picture that is sky is known
        const Strictness of_picture{
            .bias = strictness.bias * share * truth[0] / (share * truth[0] + 1 - share),
            .tests = strictness.tests};
        const RenderResult result = render_for(
            of_picture, ball(tau, albedos),
            square_settings("path", orthographic({0, 0, 2}, {0, 0, 0}, 2), 64, 16));
        for (std::size_t c = 0; c < 3; ++c) {
            const Estimate picture = image_mean(result, channels[c]);
            const Estimate disc = {
                (picture.mean - 1 + share) / share, picture.error / share, picture.degrees};
            EXPECT_TRUE(has_mean(disc, truth[c], strictness)) << tau << ", " << channels[c];
        }
    }
}

// The light that reaches the middle of a ball of tau 5 and albedo 0.5: several directions a stop
// take the noise out of the few paths that get there.
TEST(MediaSphere, LetsLittleIntoItsCentre_long) {
    WAVEPATH_SKIP_UNLESS_LONG();
    const Strictness strictness{.truth_error = 10 * icosphere_sagitta(subdivisions)};
    RenderSettings settings =
        square_settings("path", perspective({0, 0, 0}, {1, 0.3, 0.2}, 1), 32, 64);
    settings.method.distances = Distances::truncated;
    settings.splits = {1, 3, 1};
    settings.split_depth = 2;
    EXPECT_TRUE(has_mean(
        image_mean(render_for(strictness, ball(5, {0.5F, 0.5F, 0.5F}), settings)), .026541475,
        strictness));
}

// A ball that glows as its walls would: sigma_a B everywhere. With a sky of radiance B around it
// it could not be seen; under a black one it shows what the sky does not.
TEST(MediaSphere, GlowsAsTheSkyLeavesOver) {
    constexpr double truth[] = {1 - .451064701, 1 - .850197215, 1 - .998353322};
    Scene scene = ball(1, {0.5F, 0.9F, 0.999F});
    scene.environment.reset();
    Medium& medium = scene.materials[0].medium;
    medium.emission = medium.sigma_a;
    const Strictness strictness{.tests = 3, .truth_error = 2 * icosphere_sagitta(subdivisions)};
    const RenderResult result =
        render_for(strictness, scene, square_settings("path", beside(0.5), 16, 256), "B");
    for (std::size_t c = 0; c < 3; ++c)
        EXPECT_TRUE(has_mean(shared_mean(result, channels[c]), truth[c], strictness))
            << channels[c];
}

// A source in the middle of a ball of a medium in a Lambert cavity: a smaller ball of the same
// medium that emits. Of its power the share p leaves the ball, by quadrature of the integral
// equation; walls of radius a reflect 1 / a^2 of what meets them into the ball, which lets
// the share Tm out again.
void expect_lit_cavity(double source, double p) {
    constexpr double tau = 1;
    constexpr double albedo = 0.5;
    constexpr double tm = .542257109;
    constexpr double a = 1.1;
    constexpr float rho = 0.8F;
    Scene scene = scene_named("cavity");
    add_icosphere(scene, boundary_of(medium_of(tau, albedo)), {0, 0, 0}, 1, subdivisions);
    Medium emitting = medium_of(tau, albedo);
    emitting.emission = grey(1);
    add_icosphere(scene, boundary_of(emitting), {0, 0, 0}, source, subdivisions);
    add_icosphere(scene, lambert(grey(rho)), {0, 0, 0}, a, subdivisions, Facing::inward);
    // the film lies between ball and wall
    const Camera camera = orthographic({1.05, 0, 0}, {1.1, 0, 0}, 1e-2);
    const double power = 4 * std::numbers::pi * 4 * std::numbers::pi / 3 * std::pow(source, 3);
    const double back = 1 - (1 - tm) / (a * a);
    const double irradiance = power * p / (4 * std::numbers::pi * a * a) / (1 - rho * back);
    const Strictness strictness{.truth_error = 3 * icosphere_sagitta(subdivisions)};
    const RenderResult result =
        render_for(strictness, scene, square_settings("path", camera, 16, 256));
    EXPECT_TRUE(has_mean(shared_mean(result), rho * irradiance / std::numbers::pi, strictness));
}

TEST(MediaSphere, LightsItsCavityFromTheCentre) {
    expect_lit_cavity(0.7, .6132205);
}

TEST(MediaSphere, LightsItsCavityFromASmallSource_long) {
    WAVEPATH_SKIP_UNLESS_LONG();
    expect_lit_cavity(0.4, .5768141);
}

// All of the table but b = 0.99, which a mesh does not reach, and the centre of a dark ball of tau
// 5, which has a test of its own (0 here).
TEST(MediaSphere, ShinesByTheWholeTable) {
    const struct {
        double tau;
        double truth[4][3];  // at b = 0, 0.5, 0.9 and from the centre
    } rows[] = {
        {0.5,
         {{.620184678, .909709702, .909709702},
          {.656696119, .919456158, .919456158},
          {.799286820, .954685991, .954685991},
          {.762446254, .943284818, .943284818}}},
        {1,
         {{.410499046, .835122040, .998174104},
          {.451064701, .850197215, .998353322},
          {.638887721, .908531617, .999016127},
          {.560834571, .874800865, .998605963}}},
        {2,
         {{.233225025, .720487127, .720487127},
          {.261840211, .741066374, .741066374},
          {.429933123, .824129228, .824129228},
          {.281549103, .716303202, .716303202}}},
        {5,
         {{.145099913, .549384948, .991568447},
          {.158570702, .574238911, .992261153},
          {.235895799, .672756129, .994601543},
          {0, .290799935, .983899767}}}};
    const Camera cameras[] = {
        beside(0), beside(0.5), beside(0.9), perspective({0, 0, 0}, {1, 0.3, 0.2}, 1)};
    for (const auto& [tau, truth] : rows) {
        const Rgb albedos{0.5F, 0.9F, tau == 1 || tau == 5 ? 0.999F : 0.9F};
        for (std::size_t k = 0; k < 4; ++k) {
            // beside(0.9) meets the ball at a slant of 64 degrees
            const Strictness strictness{
                .tests = 48,
                .truth_error = (k == 2 ? 6 : 2) * tau * icosphere_sagitta(subdivisions)};
            RenderSettings settings = square_settings("path", cameras[k], 16, 256);
            settings.method.distances = Distances::truncated;
            const std::size_t first = truth[k][0] > 0 ? 0 : 1;
            const RenderResult result =
                render_for(strictness, ball(tau, albedos), settings, channels[first]);
            // beside(0.9) facets differ from one another: pixels have means of their own
            for (std::size_t c = first; c < 3; ++c)
                EXPECT_TRUE(has_mean(image_mean(result, channels[c]), truth[k][c], strictness))
                    << "tau " << tau << ", view " << k << ", " << channels[c];
        }
    }
}

// Light of 0..5 scatterings, for albedos 0.5, 0.9 and 1 at once.
TEST(MediaSphere, HasTheOrdersOfTheDepthAsked) {
    constexpr Rgb albedos{0.5F, 0.9F, 1};
    const struct {
        double tau, b;
        double orders[6];
    } rows[] = {
        {1, 0, {.135335283, .399866655, .221192113, .118125928, .061522284, .031554948}},
        {1, 0.5, {.176921206, .410955052, .206042337, .102928009, .051440134, .025755640}},
        {1, 0.9, {.418206567, .363710990, .122446482, .050462155, .023116173, .011122473}},
        {2, 0, {.018315639, .277647457, .193869174, .140515674, .102462975, .074546204}}};
    for (const auto& [tau, b, orders] : rows)
        for (const uint32_t depth : {1U, 2U, 5U}) {
            // beside(0.9) meets the ball at a slant of 64 degrees
            const Strictness strictness{
                .tests = 36,
                .truth_error = (b > 0.5 ? 6 : 2) * tau * icosphere_sagitta(subdivisions)};
            RenderSettings settings = square_settings("bsdf", beside(b), 16, 256);
            settings.termination = {TerminationKind::depth, depth, 1};
            // facets differ from one another there, too: the noise between pixels is larger
            const Strictness stricter{.bias = 0.8 * strictness.bias, .tests = strictness.tests};
            const RenderResult result = render_for(stricter, ball(tau, albedos), settings);
            for (std::size_t c = 0; c < 3; ++c) {
                double truth = 0;
                for (uint32_t k = 0; k <= depth; ++k)
                    truth += std::pow(double{albedos[c]}, k) * orders[k];
                EXPECT_TRUE(has_mean(image_mean(result, channels[c]), truth, strictness))
                    << "tau " << tau << ", b " << b << ", depth " << depth << ", " << channels[c];
            }
        }
}

// Methods and distances that differ under a sky, which is nowhere to aim at; equiangular stops have
// a cavity (media_distance_test). In a ball segments are short, so that all of them have a finite
// variance; along a wide plate uniform stops have none.
TEST(MediaSphere, IsTheSameByEveryMethodAndDistance) {
    const Scene scene = ball(1, {0.9F, 0.9F, 0.9F});
    const Strictness strictness{.tests = 12, .truth_error = 2 * icosphere_sagitta(subdivisions)};
    for (const char* method : {"path", "direct", "mis"})
        for (const Distances distances :
             {Distances::exponential, Distances::uniform, Distances::truncated})
            for (const bool phase : {true, false}) {
                if (!phase && method != std::string("path")) continue;
                SCOPED_TRACE(fmt::format(
                    "{}, {}, {} directions", method, name_of(distances),
                    phase ? "phase" : "uniform"));
                RenderSettings settings = square_settings(method, beside(0), 16, 256);
                settings.method.distances = distances;
                settings.method.phase_directions = phase;
                EXPECT_TRUE(has_mean(
                    image_mean(render_for(strictness, scene, settings)), .835122040, strictness));
            }
}

}  // namespace
}  // namespace wavepath
