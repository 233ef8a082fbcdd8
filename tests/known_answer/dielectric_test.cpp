// Panes and slabs of glass: alone, over a floor, in one another, around what scatters, and rough.
#include "support/media.h"
#include "support/rendering.h"

#include <cmath>
#include <numbers>

namespace wavepath {
namespace {

constexpr const char* channels[] = {"R", "G", "B"};

Scene pane(const Material& material) {
    Scene scene = scene_named("pane");
    add_box(scene, material, {-40, -40, -1}, {40, 40, 0}, Facing::outward);
    return scene;
}

// By a tracer that averages polarisation at each interface: R = 2 R1 / (1 + R1) without absorption;
// sigma_a d = 0.5 along the normal. A black plane below hides what the pane transmits.
TEST(Dielectric, PaneReflectsAndTransmits) {
    const struct {
        double mu, absorption;
        bool plane;
        double truth;
    } cases[] = {
        {1, 0, true, .0769230769231},
        {0.5, 0, true, .1637675372900},
        {0.5, 0.5, true, .110977612649},
        {1, 0.5, false, .0535694948204 + .559307868577},
        {0.5, 0.5, false, .110977612649 + .450738834233}};
    for (const auto& c : cases) {
        SCOPED_TRACE(fmt::format("mu {}, absorption {}, plane {}", c.mu, c.absorption, c.plane));
        Scene scene = pane(glass(1.5, medium_of(c.absorption, 0)));
        scene.environment = constant_environment(1);
        if (c.plane) add_square(scene, lambert(grey(0)), {0, 0, -1.1}, {0, 0, 1}, 100);
        const Strictness strictness{.tests = std::size(cases), .truth_error = 1e-6};
        const RenderSettings settings = square_settings("mis", along(c.mu), 16, 256);
        EXPECT_TRUE(
            has_mean(shared_mean(render_for(strictness, scene, settings)), c.truth, strictness));
    }
}

// Light that glass lets through is met by chance in every method: `direct` adds what its light
// points cannot reach.
TEST(Dielectric, PaneIsTheSameByEveryMethod) {
    const Strictness strictness{.tests = 2 * methods().size(), .truth_error = 1e-6};
    Scene sky = pane(glass(1.5, medium_of(0.5, 0)));
    Scene lamp = sky;
    sky.environment = constant_environment(1);
    add_square(lamp, lambert(grey(0), grey(1)), {0, 0, -1.1}, {0, 0, 1}, 100);
    for (const Method& method : methods()) {
        SCOPED_TRACE(method.name);
        const RenderSettings settings = square_settings(method.name, along(0.5), 16, 256);
        EXPECT_TRUE(has_mean(
            shared_mean(render_for(strictness, sky, settings)), .110977612649 + .450738834233,
            strictness));
        EXPECT_TRUE(has_mean(
            shared_mean(render_for(strictness, lamp, settings)), .450738834233, strictness));
    }
}

// The whole table, each of R and T by itself: a black plane below hides what is transmitted, a
// white-hot one under a black sky shows it. The last column's T at 89 degrees would take 4 10^8
// samples (0 here).
TEST(Dielectric, PaneByTheWholeTable_long) {
    WAVEPATH_SKIP_UNLESS_LONG();
    const struct {
        double degrees;
        double clear[2], absorbing[2];  // R, T
    } rows[] = {
        {0, {.0769230769231, .923076923077}, {.0535694948204, .559307868577}},
        {30, {.0797344674810, .920265532519}, {.0547376819633, .540883366391}},
        {45, {.0956732085411, .904326791459}, {.0648342996772, .512104832171}},
        {56.309932474020215, {.1377410468320, .862258953168}, {.0930646327157, .470968268655}},
        {60, {.1637675372900, .836232462710}, {.110977612649, .450738834233}},
        {75, {.4039079522010, .596092047799}, {.291941082467, .295348854837}},
        {85, {.7599203621650, .240079637835}, {.639551371019, .0852090464497}},
        {89, {.9496818572000, .050318142800}, {.906945344474, 0}}};
    const Strictness strictness{.tests = 31, .truth_error = 1e-5};
    for (const auto& [degrees, clear, absorbing] : rows) {
        const double mu = std::cos(degrees * std::numbers::pi / 180);
        const RenderSettings settings = square_settings("mis", along(mu), 16, 256);
        for (const bool absorbs : {false, true}) {
            const double* const truth = absorbs ? absorbing : clear;
            SCOPED_TRACE(fmt::format("{} degrees, absorbing {}", degrees, absorbs));
            Scene above = pane(glass(1.5, medium_of(absorbs ? 0.5 : 0, 0)));
            Scene below = above;
            above.environment = constant_environment(1);
            add_square(above, lambert(grey(0)), {0, 0, -1.1}, {0, 0, 1}, 100);
            add_square(below, lambert(grey(0), grey(1)), {0, 0, -1.1}, {0, 0, 1}, 100);
            EXPECT_TRUE(has_mean(
                shared_mean(render_for(strictness, above, settings)), truth[0], strictness));
            if (truth[1] == 0) continue;
            EXPECT_TRUE(has_mean(
                shared_mean(render_for(strictness, below, settings)), truth[1], strictness));
        }
    }
}

// A pane over Lambert's floor of albedo rho, the environment above: a light point is never
// connected through the glass. Rs(mu) + (1 - Rs) rho (1 - Rd) / (1 - rho Rd), Rs of the pane, Rd of
// diffuse light. The channels are floors.
TEST(Dielectric, PaneOverAFloor) {
    const struct {
        double mu;
        double truth[3];
    } cases[] = {
        {1, {.4995668589, .7891663438, 1}},
        {0.5, {.5466483588, .8090018902, 1}},
        {0.2, {.7323096663, .8872214345, 1}}};
    Scene scene = pane(glass(1.5));
    scene.environment = constant_environment(1);
    add_square(scene, lambert({0.5F, 0.8F, 1}), {0, 0, -1.01}, {0, 0, 1}, 80);
    const Strictness strictness{.tests = 3 * std::size(cases), .truth_error = 2e-6};
    for (const auto& [mu, truth] : cases) {
        const RenderResult result =
            render_for(strictness, scene, square_settings("mis", along(mu), 16, 256));
        for (std::size_t c = 0; c < 3; ++c)
            EXPECT_TRUE(has_mean(shared_mean(result, channels[c]), truth[c], strictness))
                << "mu " << mu << ", " << channels[c];
    }
}

// n 2, in it n 1.33, along the normal: T = 1 / (1 + sum R / (1 - R)) over four interfaces. The fog
// far aside makes indices a matter of the whole stack of media. One index for both would give .8.
TEST(Dielectric, BodiesInOneAnotherHaveTheirOwnIndices) {
    Scene scene = pane(glass(2));
    add_box(scene, glass(1.33), {-30, -30, -0.8}, {30, 30, -0.2}, Facing::outward);
    add_box(scene, boundary_of(medium_of(1, 0.5)), {50, -1, -1}, {52, 1, 0}, Facing::outward);
    add_square(scene, lambert(grey(0), grey(1)), {0, 0, -1.1}, {0, 0, 1}, 100);
    const double outer = std::pow((2 - 1) / (2 + 1.), 2);
    const double inner = std::pow((2 - 1.33) / (2 + 1.33), 2);
    const double transmittance = 1 / (1 + 2 * outer / (1 - outer) + 2 * inner / (1 - inner));
    const Strictness strictness{.truth_error = 1e-6};
    const RenderSettings settings = square_settings("mis", along(1), 16, 256);
    EXPECT_TRUE(
        has_mean(shared_mean(render_for(strictness, scene, settings)), transmittance, strictness));
}

// Fresnel's 4 % and the medium behind: n = 1.5, albedo 0.9, isotropic, by adding-doubling.
TEST(Dielectric, SlabOfAScatteringMedium) {
    Scene scene = pane(glass(1.5, medium_of(1, 0.9)));
    scene.environment = constant_environment(1);
    constexpr std::array distances{Distances::exponential, Distances::truncated};
    const Strictness strictness{.tests = 2 * distances.size(), .truth_error = 1e-6};
    for (const Distances distance : distances)
        for (const auto& [mu, truth] :
             {std::pair{1.0, .221989919 + .505951304}, {0.5, .286434242 + .421845674}}) {
            SCOPED_TRACE(fmt::format("{}, mu {}", name_of(distance), mu));
            RenderSettings settings = square_settings("mis", along(mu), 16, 256);
            settings.method.distances = distance;
            EXPECT_TRUE(
                has_mean(shared_mean(render_for(strictness, scene, settings)), truth, strictness));
        }
}

// As thick as to let nothing through: .2600 by Giovanelli (1955), of which .04 is Fresnel's.
TEST(Dielectric, HalfSpaceOfAScatteringMedium) {
    Scene scene = scene_named("half-space");
    scene.environment = constant_environment(1);
    add_box(scene, glass(1.5, medium_of(30, 0.9)), {-1, -1, -1}, {1, 1, 0}, Facing::outward);
    EXPECT_TRUE(has_mean(
        shared_mean(render_for({}, scene, square_settings("mis", along(1), 16, 256))), .259918570));
}

// More slabs of the kind: albedo towards 1, thick, anisotropic; what they reflect and transmit.
TEST(Dielectric, SlabsByAddingDoubling_long) {
    WAVEPATH_SKIP_UNLESS_LONG();
    const struct {
        double tau, albedo, g;
        double truth[2][2];  // mu 1, 0.5: R, T
    } cases[] = {
        {1, 0.9, 0, {{.221989919, .505951304}, {.286434242, .421845674}}},
        {1, 1, 0, {{.358948128, .641051872}, {.433476646, .566523354}}},
        {10, 1, 0, {{.775694439, .224305561}, {.797767486, .202232514}}},
        {30, 0.9, 0, {{.259918570, 0}, {.310769432, 0}}},
        {10, 0.999, 0, {{.749368455, .204947015}, {.773382923, .184587787}}},
        {2, 0.9, 0.75, {{.126822160, .493146352}, {.197470008, .352434322}}},
        {10, 0.999, 0.8, {{.484914452, .469919182}, {.532853088, .423807426}}}};
    for (const auto& [tau, albedo, g, truth] : cases) {
        Scene above = pane(glass(1.5, medium_of(tau, albedo, g)));
        Scene below = above;
        above.environment = constant_environment(1);
        add_square(above, lambert(grey(0)), {0, 0, -1.001}, {0, 0, 1}, 100);
        add_square(below, lambert(grey(0), grey(1)), {0, 0, -1.001}, {0, 0, 1}, 100);
        const Strictness strictness{.tests = 28, .truth_error = 1e-6};
        for (std::size_t k = 0; k < 2; ++k) {
            SCOPED_TRACE(fmt::format("tau {}, albedo {}, g {}, view {}", tau, albedo, g, k));
            const RenderSettings settings =
                square_settings("bsdf", along(k == 0 ? 1 : 0.5), 16, 256);
            EXPECT_TRUE(has_mean(
                shared_mean(render_for(strictness, above, settings)), truth[k][0], strictness));
            if (truth[k][1] == 0) continue;
            EXPECT_TRUE(has_mean(
                shared_mean(render_for(strictness, below, settings)), truth[k][1], strictness));
        }
    }
}

// Light points of a sky on rough glass against directions of the lobe alone: seen from within, and
// mirrored in it, which is a hundredth of the light.
void expect_lit_alike(bool within, double bias) {
    Medium black;
    black.sigma_a = grey(20);
    Material material = glass(1.5, black);
    material.roughness = 1;
    Scene scene = pane(material);
    scene.environment = constant_environment(1);
    const Vec3d eye{0.1, 0.2, within ? -1e-3 : 1};
    const auto mean = [&](const char* method) {
        return shared_mean(render_for(
            {.bias = bias / 1.5}, scene,
            square_settings(method, orthographic(eye, {0.1, 0.2, 0}, 0.1), 32, 64)));
    };
    EXPECT_TRUE(agree(mean("bsdf"), mean("direct-bsdf"), {.bias = bias})) << within;
}

TEST(RoughDielectric, IsLitAlikeFromWithin) {
    expect_lit_alike(true, .01);
}

TEST(RoughDielectric, IsLitAlikeOnBothSides_long) {
    WAVEPATH_SKIP_UNLESS_LONG();
    expect_lit_alike(true, .005);
    expect_lit_alike(false, .005);
}

}  // namespace
}  // namespace wavepath
