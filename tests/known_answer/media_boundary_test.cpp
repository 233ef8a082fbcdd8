// Boundaries that nobody may see, and what passes them: rays, connections, branches.
#include "scene/transform.h"
#include "support/images.h"
#include "support/media.h"
#include "support/rendering.h"

#include <cmath>
#include <numbers>

namespace wavepath {
namespace {

// A floor under a square light; F = .2394564704607735 at the origin. Boundaries around nothing, put
// where shadow rays find it hard, change no bit.
TEST(MediaBoundary, AroundNothingIsNotThere) {
    constexpr double near = 1e-4;
    const struct {
        const char* what;
        Vec3d low, high;
    } cases[] = {
        {"between", {-3, -3, 0.3}, {3, 3, 0.7}},
        {"below the lamp", {-3, -3, 0.2}, {3, 3, 1 - near}},
        {"around all, the camera too", {-3, -3, -1}, {3, 3, 1.5}},
        {"through floor and lamp", {-0.2, -0.3, -1}, {0.25, 0.35, 1.5}},
        {"above the floor", {-3, -3, near}, {3, 3, 0.5}},
        {"in the plane of the floor", {-3, -3, 0}, {3, 3, 0.5}},
    };
    // of one extent and with the same features: the same numbers are drawn
    const auto with_boundary = [](const Vec3d& low, const Vec3d& high) {
        Scene scene = scene_named("floor and light");
        add_square(scene, lambert(grey(1)), {0, 0, 0}, {0, 0, 1}, 0.1);
        add_square(scene, lambert(grey(0), grey(1), true), {0, 0, 1}, {0, 0, -1}, 1);
        add_box(scene, lambert(grey(0)), {-3, -3, -1}, {-2.9, -2.9, -0.9}, Facing::outward);
        add_box(scene, lambert(grey(0)), {2.9, 2.9, 1.4}, {3, 3, 1.5}, Facing::outward);
        add_box(scene, boundary_of({}), low, high, Facing::outward);
        return scene;
    };
    const Scene aside = with_boundary({-2, -2, -0.9}, {-1.9, -1.9, -0.8});
    for (const char* method : {"bsdf", "direct", "mis"}) {
        const RenderSettings settings =
            square_settings(method, close_up({0, 0, 0}, {0, 0, 1}, 0.1, 2e-3), 16, 64);
        const RenderResult truth = render_scene(aside, settings);
        for (const auto& [what, low, high] : cases) {
            SCOPED_TRACE(fmt::format("{}, {}", what, method));
            const RenderResult result = render_scene(with_boundary(low, high), settings);
            const auto& expected = truth.film.image.channels.at("R");
            for (std::size_t i = 0; i < expected.size(); ++i)
                ASSERT_EQ(result.film.image.channels.at("R")[i], expected[i]) << i;
        }
    }
    const RenderResult lit = render_for(
        {}, aside, square_settings("mis", close_up({0, 0, 0}, {0, 0, 1}, 0.1, 2e-3), 16, 256));
    EXPECT_TRUE(has_mean(shared_mean(lit), .2394564704607735, {.truth_error = 1e-5}));
}

// A furnace whose wall stands behind eight boundaries: they spend neither depth nor chances of
// survival.
TEST(MediaBoundary, IsNoScattering) {
    Scene scene = scene_named("shells");
    add_box(scene, lambert(grey(0.5F), grey(1)), {-2, -2, -2}, {2, 2, 2}, Facing::inward);
    for (const double half : {1.9, 1.5, 1.0, 0.5})
        add_box(scene, boundary_of({}), {-half, -half, -half}, {half, half, half}, Facing::outward);
    RenderSettings settings =
        square_settings("path", perspective({0.1, 0, 0.2}, {-1, -0.4, -0.9}, 1.2), 32, 4);
    settings.termination = {TerminationKind::depth, 2, 1};
    EXPECT_NEAR(shared_mean(render_scene(scene, settings)).mean, 1.75, 1e-6);
    settings.termination = {TerminationKind::roulette_constant, 0, 0.8F};
    settings.samples = 64;
    EXPECT_TRUE(has_mean(image_mean(render_for({}, scene, settings)), 2));
}

// A floor .45 free paths deep in what absorbs, under a white sky: rho 2 E3(tau) exp(-tau / mu), by
// one direction from the floor or by several.
TEST(MediaBoundary, IsPassedOnceByWhatBranchesBehindIt) {
    Scene scene = scene_named("floor in soot");
    scene.environment = constant_environment(1);
    add_slab(scene, medium_of(0.5, 0));
    add_square(scene, lambert(grey(0.8F)), {0, 0, -0.9}, {0, 0, 1}, 80);
    const Strictness strictness{.tests = 6, .truth_error = 1e-6};
    for (const char* method : {"bsdf", "mis"})
        for (const Splits& splits : {Splits{1, 1, 1}, Splits{1, 1, 3}, Splits{2, 2, 2}}) {
            RenderSettings settings = square_settings(method, along(1), 16, 64);
            settings.termination = {TerminationKind::depth, 1, 1};
            settings.method.distances = Distances::truncated;
            settings.splits = splits;
            settings.split_depth = 2;
            EXPECT_TRUE(has_mean(
                shared_mean(render_for(strictness, scene, settings)), .2434847242, strictness))
                << method << ", " << splits.reflections;
        }
}

// The same where the surroundings scatter: what is seen from outside is one mean by all ways to
// branch.
TEST(MediaBoundary, IsPassedOnceByWhatBranchesInFog) {
    Scene scene = scene_named("floor in fog");
    add_slab(scene, medium_of(1, 0.7, 0.3), 3);
    add_square(scene, lambert({0.8F, 0.4F, 0.2F}), {0, 0, -0.9}, {0, 0, 1}, 4);
    PunctualLight sun;
    sun.kind = LightKind::directional;
    sun.intensity = {3, 3, 3};
    sun.direction = normalized({0.3, 0.1, -1});
    scene.lights.push_back(sun);
    const auto mean = [&](const Splits& splits, Distances distances) {
        RenderSettings settings =
            square_settings("mis", perspective({0, -2, 2}, {0, 0, -0.5}, 0.4), 16, 64);
        settings.method.distances = distances;
        settings.splits = splits;
        settings.split_depth = 2;
        return image_mean(render_for({.bias = 0.01 / 1.5, .tests = 3}, scene, settings));
    };
    const Estimate truth = mean({1, 1, 1}, Distances::exponential);
    for (const Distances distances :
         {Distances::uniform, Distances::truncated, Distances::equiangular})
        EXPECT_TRUE(agree(mean({3, 2, 2}, distances), truth, {.bias = 0.01, .tests = 3}))
            << name_of(distances);
}

// Two balls in one another: the medium entered last fills the space. Chords along a diameter.
TEST(MediaBoundary, InnermostMediumWins) {
    Scene scene = scene_named("nested");
    scene.environment = constant_environment(1);
    const auto absorbing = [](double sigma) { return boundary_of(medium_of(sigma, 0)); };
    add_box(scene, absorbing(0.5), {-2, -2, -2}, {2, 2, 2}, Facing::outward);
    add_box(scene, absorbing(2), {-1, -1, -1}, {1, 1, 1}, Facing::outward);
    add_box(scene, boundary_of({}), {-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}, Facing::outward);
    const auto radiance = [&](const Camera& camera) {
        return shared_mean(render_scene(scene, square_settings("mis", camera, 8, 4))).mean;
    };
    EXPECT_NEAR(
        radiance(orthographic({0.1, 0.1, 5}, {0.1, 0.1, 0}, 0.1)) / std::exp(-2 * 0.5 - 2), 1,
        1e-5);
    // from the bubble, and from the shell around it
    EXPECT_NEAR(
        radiance(orthographic({0, 0, 0.1}, {0, 0, 1}, 0.1)) / std::exp(-0.5 * 2 - 0.5), 1, 1e-5);
    EXPECT_NEAR(
        radiance(orthographic({0, 0, 0.75}, {0, 0, 1}, 0.1)) / std::exp(-0.25 * 2 - 0.5), 1, 1e-5);
}

// Two sheets of clear boundaries between a floor and a point light: each of the four crossings
// tints what arrives, by the factor and by its texture.
TEST(MediaBoundary, TintsConnections) {
    Material tinted = boundary_of({});
    tinted.base_color = {0.5F, 0.8F, 1};
    Scene scene = scene_named("filters");
    add_square(scene, lambert(grey(1)), {0, 0, 0}, {0, 0, 1}, 4);
    add_box(scene, tinted, {-1, -1, 0.3}, {1, 1, 0.4}, Facing::outward);
    Primitive& textured = add_box(scene, tinted, {-1, -1, 0.5}, {1, 1, 0.6}, Facing::outward);
    textured.uvs[0].assign(textured.positions.size() / 3 * 2, 0.5F);
    add_texture(
        scene, scene.materials.back(), TEXTURE_BASE_COLOR, image_of(1, 1, {255, 188, 128, 255}));
    scene.lights.push_back({});
    scene.lights.back().position = {0, 0, 1};
    const RenderResult result = render_scene(
        scene, square_settings("direct", close_up({0, 0, 0}, {0, 0, 1}, 0.1, 2e-3), 8, 4));
    const double truths[] = {
        std::pow(0.5, 4), std::pow(0.8, 4) * std::pow(188 / 255., 2), std::pow(128 / 255., 2)};
    const char* channels[] = {"R", "G", "B"};
    for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(shared_mean(result, channels[c]).mean * std::numbers::pi / truths[c], 1, 2e-5)
            << channels[c];
}

// Fog that ends a little below a lamp, however little: a shadow ray that is pushed off the boundary
// would meet the lamp, and fog come out a tenth too dark there.
TEST(MediaBoundary, OfFogMayLieCloseToItsLamp) {
    Medium fog = medium_of(0.5, 0.9);
    const auto lit = [&](double gap) {
        Scene scene = scene_named("fog below a lamp");
        add_square(scene, lambert(grey(0.5F)), {0, 0, 0}, {0, 0, 1}, 4);
        add_square(scene, lambert(grey(0), grey(1)), {0, 0, 1}, {0, 0, -1}, 0.5);
        add_box(scene, boundary_of(fog), {-1, -1, -0.1}, {1, 1, 1 - gap}, Facing::outward);
        return image_mean(render_for(
            {.bias = 0.01 / 1.5, .tests = 3}, scene,
            square_settings("mis", perspective({0, -0.9, 0.5}, {0, 0, 0.45}, 0.9), 32, 64)));
    };
    const Estimate apart = lit(5e-3);
    for (const double gap : {1e-3, 1e-4, 1e-6})
        EXPECT_TRUE(agree(lit(gap), apart, {.bias = 0.01, .tests = 3})) << gap;
}

// Two fogs in one another that end at a floor, a little above it, or reach into it: the floor lies
// in fog, whichever is met first.
TEST(MediaBoundary, OfFogMayEndAtAFloor) {
    const auto lit = [](double low, bool floor_first) {
        Scene scene = scene_named("fog on a floor");
        scene.environment = constant_environment(1);
        if (floor_first) add_square(scene, lambert(grey(0.8F)), {0, 0, 0}, {0, 0, 1}, 4);
        add_box(scene, boundary_of(medium_of(1, 0)), {-2, -2, low}, {2, 2, 1}, Facing::outward);
        add_box(
            scene, boundary_of(medium_of(0.2, 0)), {-1.9, -1.9, 2 * low}, {1.9, 1.9, 0.5},
            Facing::outward);
        if (!floor_first) add_square(scene, lambert(grey(0.8F)), {0, 0, 0}, {0, 0, 1}, 4);
        return shared_mean(render_for(
            {.bias = 0.01 / 1.5, .tests = 8}, scene,
            square_settings("mis", orthographic({0.1, 0.03, 3}, {0.1, 0.03, 0}, 0.01), 16, 64)));
    };
    const Estimate truth = lit(-0.1, true);
    for (const double low : {0.0, 1e-7, 1e-6, 1e-5})
        for (const bool floor_first : {true, false})
            EXPECT_TRUE(agree(lit(low, floor_first), truth, {.bias = 0.01, .tests = 8}))
                << low << ", floor first: " << floor_first;
}

}  // namespace
}  // namespace wavepath
