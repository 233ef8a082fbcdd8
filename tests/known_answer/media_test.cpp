// What holds for media of any shape: furnaces, isothermal enclosures, mean chords, and boundaries
// that must not be there.
#include "support/media.h"
#include "scene/transform.h"
#include "support/images.h"
#include "support/rendering.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <random>

namespace wavepath {
namespace {

// Albedo 1 in an enclosure of one radiance: nobody can see that the medium is there.
TEST(Media, ThatOnlyScattersIsInvisibleInAFurnace) {
    const Camera outside = perspective({0.2, 0.1, 1.6}, {0, 0, 0}, 0.9);
    const Camera inside = perspective({0.1, 0.05, 0.2}, {-1, -0.4, -0.9}, 1.6);
    const struct {
        double g;
        const Camera& camera;
        const char* method;
    } cases[] = {{0, outside, "path"}, {0.9, inside, "mis"}, {-0.9999, outside, "mis"}};
    for (const auto& [g, camera, method] : cases) {
        Scene scene = scene_named("furnace");
        add_box(scene, lambert(grey(0), grey(1)), {-2, -2, -2}, {2, 2, 2}, Facing::inward);
        add_icosphere(scene, boundary_of(medium_of(4, 1, g)), {0, 0, 0}, 1, 2);
        const Strictness strictness{.tests = std::size(cases)};
        const RenderResult result =
            render_for(strictness, scene, square_settings(method, camera, 32, 64));
        EXPECT_TRUE(has_mean(shared_mean(result), 1, strictness)) << method << ", g " << g;
    }
}

// Medium and walls at one temperature: walls emit (1 - rho) B, the medium sigma_a B.
TEST(Media, AtOneTemperatureIsInvisible) {
    for (const double g : {0.0, 0.75}) {
        Medium medium = medium_of(3, 0.6, g);
        medium.emission = medium.sigma_a;
        Scene scene = scene_named("isothermal");
        add_box(scene, lambert(grey(0.5F), grey(0.5F)), {-2, -2, -2}, {2, 2, 2}, Facing::inward);
        add_box(scene, boundary_of(medium), {-1, -0.5, -1}, {1, 0.7, 1}, Facing::outward);
        for (const char* method : {"path", "mis"}) {
            const RenderResult result = render_for(
                {.tests = 4}, scene,
                square_settings(method, perspective({1.7, 1, 1.6}, {0, 0, 0}, 0.9), 32, 64));
            EXPECT_TRUE(has_mean(image_mean(result), 1, {.tests = 4})) << method << ", g " << g;
        }
    }
}

// Boxes of 1 x 1/2 x 1/4 in cells of black walls, each turned its own way: a square view straight
// down sees them from directions spread evenly over a half-sphere (Fibonacci's spiral).
Scene turned_boxes(const Medium& medium, int rows, double cell) {
    Scene scene = scene_named("turned boxes");
    add_box(scene, boundary_of(medium), {-0.5, -0.25, -0.125}, {0.5, 0.25, 0.125}, Facing::outward);
    scene.instances.clear();
    const auto middle = [&](int k) { return (k - 0.5 * (rows - 1)) * cell; };
    const int boxes = rows * rows;
    for (int k = 0; k < boxes; ++k) {
        const double z = (k + 0.5) / boxes;
        const double turn = 2 * std::numbers::pi * k / std::numbers::phi;
        const double sine = std::sqrt(1 - z * z);
        // the box's own direction that is turned up, and two across
        const Vec3d up{sine * std::cos(turn), sine * std::sin(turn), z};
        const Vec3d u = normalized(cross({-std::sin(turn), std::cos(turn), 0}, up));
        const Vec3d v = cross(up, u);
        Matrix4 to_world = identity_matrix;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            to_world[4 * axis] = u[axis];
            to_world[4 * axis + 1] = v[axis];
            to_world[4 * axis + 2] = up[axis];
        }
        to_world[12] = middle(k % rows);
        to_world[13] = middle(k / rows);
        scene.instances.push_back({0, to_world, static_cast<uint32_t>(k)});
    }
    const double side = rows * cell;
    for (int k = 0; k <= rows; ++k) {
        const double x = middle(k) - 0.5 * cell;
        add_square(scene, lambert(grey(0)), {x, 0, 0}, {1, 0, 0}, side);
        add_square(scene, lambert(grey(0)), {0, x, 0}, {0, 1, 0}, side);
    }
    return scene;
}

// Rays that enter evenly over a body's surface S and by the cosine stay in it for 4 V / S on the
// mean, however it scatters, where nothing is absorbed [Blanco & Fournier 2003]. A medium that
// emits 1 a metre shows how long they stayed: integrated over a view and averaged over views, V.
TEST(Media, HasCauchysMeanChord) {
    const auto emitting = [](double sigma_s, double g) {
        Medium medium = medium_of(sigma_s, 1, g);
        medium.emission = grey(1);
        return medium;
    };
    constexpr int subdivisions = 5;
    Scene ball = scene_named("ball");
    add_icosphere(ball, boundary_of(emitting(3, 0.99)), {0, 0, 0}, 1, subdivisions);
    // a ball looks the same from everywhere
    const Strictness strictness{.tests = 2, .truth_error = icosphere_sagitta(subdivisions)};
    EXPECT_TRUE(has_mean(
        image_mean(render_for(
            strictness, ball,
            square_settings("path", orthographic({0, 0, 2}, {0, 0, 0}, 2.01), 64, 64))),
        4 * std::numbers::pi / 3 / (2.01 * 2.01), strictness));
    constexpr int rows = 16;
    constexpr double cell = 1.15;
    const Strictness of_boxes{.bias = 0.01, .tests = 2, .truth_error = 2e-4};
    EXPECT_TRUE(has_mean(
        image_mean(render_for(
            of_boxes, turned_boxes(emitting(4, -0.9), rows, cell),
            square_settings("path", orthographic({0, 0, 20}, {0, 0, 0}, rows * cell), 128, 64))),
        0.125 / (cell * cell), of_boxes));
}

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

std::string error_of(const Scene& scene, const Camera& camera) {
    try {
        render(test_device(), scene, square_settings("mis", camera, 2, 1));
        return "";
    } catch (const Error& error) {
        return error.what();
    }
}

TEST(MediaBoundary, AroundWhatIsDenserThanFloatsTellApartIsRefused) {
    Scene scene = scene_named("ball");
    scene.environment = constant_environment(1);
    add_icosphere(scene, boundary_of(medium_of(1e8, 0.9)), {0, 0, 0}, 1, 1);
    scene.materials[0].name = "soot";
    const Camera camera = perspective({0, 0, 3}, {0, 0, 0}, 1);
    EXPECT_EQ(
        error_of(scene, camera),
        "ball: material 0 \"soot\": an extinction of 1e+08 per metre makes 2.09e+08 free paths "
        "across the scene, more than single precision tells apart (1e+06); lower sigma_s and "
        "sigma_a");
    const auto warnings = [&](double sigma_t, double albedo) {
        scene.materials[0].medium = medium_of(sigma_t, albedo);
        return render_scene(scene, square_settings("mis", camera, 2, 1)).warnings;
    };
    const std::vector<std::string> warning = {
        "ball: material 0 \"soot\": an extinction of 1e+05 per metre makes 2.09e+05 free paths "
        "across the scene, which single precision renders up to 5 % too dark"};
    EXPECT_EQ(warnings(1e5, 0.5), warning);
    EXPECT_TRUE(warnings(1e4, 0.5).empty());
    EXPECT_TRUE(warnings(1e8, 0).empty());  // absorbs at once
    const auto warning_of_long_paths = warnings(1e3, 1);
    ASSERT_EQ(warning_of_long_paths.size(), 1U);
    EXPECT_THAT(
        warning_of_long_paths[0],
        testing::HasSubstr("next to nothing is absorbed: paths may take 4e+06 scatterings"));
    EXPECT_TRUE(warnings(1e2, 1).empty());
}

// Corners that an exporter rounded in each triangle by itself.
TEST(MediaBoundary, MayHaveSeamsOfRounding) {
    Scene scene = scene_named("ball");
    scene.environment = constant_environment(1);
    Primitive& ball = add_icosphere(scene, boundary_of(medium_of(1, 0)), {0, 0, 0}, 1, 2);
    std::vector<float> corners;
    std::vector<uint32_t> indices;
    std::mt19937 random(1);
    std::uniform_real_distribution<float> rounding(-1e-7F, 1e-7F);
    for (const uint32_t i : ball.indices) {
        indices.push_back(static_cast<uint32_t>(indices.size()));
        for (std::size_t k = 0; k < 3; ++k)
            corners.push_back(ball.positions[3 * i + k] + rounding(random));
    }
    ball.positions = corners;
    ball.indices = indices;
    const RenderSettings settings =
        square_settings("mis", orthographic({0, 0, 2}, {0, 0, 0}, 0.1), 2, 1);
    EXPECT_TRUE(render_scene(scene, settings).warnings.empty());
    scene.primitives[0].positions[0] += 1e-4F;
    EXPECT_EQ(render_scene(scene, settings).warnings.size(), 1U);
}

// Every face twice, one way and the other: closed, but there is no inside.
TEST(MediaBoundary, AroundNoVolumeIsWarnedOf) {
    Scene scene = scene_named("sheet");
    scene.environment = constant_environment(1);
    Primitive& sheet = add_square(scene, boundary_of(medium_of(1, 0)), {0, 0, 0}, {0, 0, 1}, 1);
    std::vector<uint32_t>& indices = sheet.indices;
    for (std::size_t i = indices.size(); i > 0; --i) indices.push_back(indices[i - 1]);
    sheet.name = "sheet";
    const RenderResult result =
        render_scene(scene, square_settings("mis", orthographic({0, 0, 1}, {0, 0, 0}, 0.1), 4, 4));
    EXPECT_EQ(
        result.warnings,
        std::vector<std::string>{
            "sheet: sheet: no volume within what bounds a medium; give it thickness, or take "
            "KHR_materials_volume away for a thin wall"});
    EXPECT_EQ(shared_mean(result).mean, 1);
}

// A box of 2 m about (x, 0, 0) without its face at z = 1.
void add_open_box(Scene& scene, double x) {
    Primitive& box = add_box(
        scene, boundary_of(medium_of(0.5, 0)), {x - 1, -1, -1}, {x + 1, 1, 1}, Facing::outward);
    std::erase_if(box.indices, [&, k = 0](uint32_t) mutable {
        const std::size_t first = static_cast<std::size_t>(k++) / 3 * 3;
        double sum = 0;
        for (std::size_t j = 0; j < 3; ++j) sum += box.positions[3 * box.indices[first + j] + 2];
        return sum > 2.5;
    });
    box.name = "box";
}

// One warning for all, and a ray is in the medium where it met an outer side and no inner one
// since.
TEST(MediaBoundary, WithAHoleIsWarnedOfOnce) {
    Scene scene = scene_named("open");
    add_square(scene, lambert(grey(0), grey(1)), {0, 0, -2}, {0, 0, 1}, 8);
    add_square(scene, lambert(grey(0), grey(1)), {0, 0, 3}, {0, 0, -1}, 8);
    add_open_box(scene, 0);
    add_open_box(scene, 2.5);
    const auto seen = [&](const Vec3d& eye, const Vec3d& target) {
        const RenderResult result =
            render_scene(scene, square_settings("mis", orthographic(eye, target, 0.1), 8, 4));
        EXPECT_EQ(
            result.warnings,
            std::vector<std::string>{
                "open: box and 1 more: not closed around a medium; rays that leave by a hole leave "
                "the medium only when they leave the scene"});
        return shared_mean(result).mean;
    };
    EXPECT_NEAR(seen({0.1, 0.2, 2}, {0.1, 0.2, 0}), 1, 1e-6);
    EXPECT_NEAR(seen({0.1, 0.2, -1.5}, {0.1, 0.2, 0}) / std::exp(-0.5 * 4), 1, 1e-5);
}

// What leaves the scene by a hole has left the medium, connections too: a floor in such a box, seen
// through a side, by a sun above the hole and by the sky.
TEST(MediaBoundary, WithAHoleHoldsNothingThatLeavesTheScene) {
    Scene scene = scene_named("open");
    add_open_box(scene, 0);
    add_square(scene, lambert(grey(0.5F)), {0, 0, 0}, {0, 0, 1}, 1.5);
    const Camera aside = orthographic({2.1, 0.2, 1}, {0.1, 0.2, 0}, 1e-3);
    PunctualLight sun;
    sun.kind = LightKind::directional;
    sun.direction = {0, 0, -1};
    sun.intensity = grey(2);
    scene.lights.push_back(sun);
    const RenderResult sunlit = render_scene(scene, square_settings("direct", aside, 8, 4));
    const double towards = std::exp(-0.5 * 0.45 * std::sqrt(5.0));
    EXPECT_NEAR(shared_mean(sunlit).mean / (towards * 2 * 0.5 / std::numbers::pi), 1, 1e-4);

    scene.lights.clear();
    scene.environment = constant_environment(1);
    const auto by = [&](const char* method) {
        return shared_mean(
            render_for({.bias = 0.0035}, scene, square_settings(method, aside, 16, 128)));
    };
    EXPECT_TRUE(agree(by("path"), by("direct")));
}

// Of two bodies with the same faces the one later in the file fills both, for paths from outside
// and for a camera inside.
TEST(MediaBoundary, OfBodiesWithTheSameFacesTheLaterFillsBoth) {
    for (const bool thin_last : {false, true}) {
        Scene scene = scene_named("twins");
        scene.environment = constant_environment(1);
        const double last = thin_last ? 0.2 : 1;
        for (const double sigma : {1.2 - last, last})
            add_box(
                scene, boundary_of(medium_of(sigma, 0)), {-1, -1, -1}, {1, 1, 1}, Facing::outward);
        const auto seen = [&](const Camera& camera) {
            return shared_mean(render_scene(scene, square_settings("mis", camera, 8, 4))).mean;
        };
        EXPECT_NEAR(
            seen(orthographic({0.1, 0.2, 3}, {0.1, 0.2, 0}, 0.1)) / std::exp(-2 * last), 1, 1e-5);
        EXPECT_NEAR(
            seen(orthographic({0.1, 0.2, 0}, {0.1, 0.2, 3}, 0.1)) / std::exp(-last), 1, 1e-5);
    }
}

// A body whose faces look inwards would fill the space around it; inside another of its material it
// is a hollow, for the camera too.
TEST(MediaBoundary, InsideOutIsAHollowOrRefused) {
    Scene scene = scene_named("shell");
    scene.environment = constant_environment(1);
    add_box(scene, boundary_of(medium_of(0.7, 0)), {-1, -1, -1}, {1, 1, 1}, Facing::inward);
    scene.primitives[0].name = "inner";
    const Camera above = orthographic({0.1, 0.2, 3}, {0.1, 0.2, 0}, 0.1);
    EXPECT_EQ(
        error_of(scene, above),
        "shell: inner is inside out, and no body of the same medium is around it that it could be "
        "a hollow in; turn its faces");
    add_box(scene, {}, {-2, -2, -2}, {2, 2, 2}, Facing::outward);
    scene.primitives[1].material = 0;
    const auto seen = [&](const Camera& camera) {
        const RenderResult result = render_scene(scene, square_settings("mis", camera, 8, 4));
        EXPECT_TRUE(result.warnings.empty());
        return shared_mean(result).mean;
    };
    EXPECT_NEAR(seen(above) / std::exp(-2 * 0.7), 1, 1e-5);
    EXPECT_NEAR(seen(orthographic({0.1, 0.2, 0}, {0.1, 0.2, 3}, 0.1)) / std::exp(-0.7), 1, 1e-5);
}

// A ray may enter by one material and leave by another where their media are equal.
TEST(MediaBoundary, OfEqualMediaIsOfOne) {
    for (const double below : {0.5, 0.7}) {
        Scene scene = scene_named("two materials");
        scene.environment = constant_environment(1);
        add_square(scene, lambert(grey(0), grey(1)), {0, 0, -3}, {0, 0, 1}, 8);
        add_box(scene, boundary_of(medium_of(0.5, 0)), {-1, -1, -1}, {1, 1, 1}, Facing::outward);
        split_off(scene, 18, boundary_of(medium_of(below, 0)));
        const RenderResult result = render_scene(
            scene, square_settings("mis", orthographic({0.1, 0.2, 3}, {0.1, 0.2, 0}, 0.1), 8, 4));
        EXPECT_EQ(result.warnings.size(), below == 0.5 ? 0U : 1U);
        if (below == 0.5) {
            EXPECT_NEAR(shared_mean(result).mean / std::exp(-0.5 * 2), 1, 1e-5);
        }
    }
}

// Four media fit. A fifth is refused where a body lies in four others, and is a NaN where bodies
// only cross: for paths, and for connections.
TEST(MediaBoundary, OfAFifthMediumIsRefusedOrFound) {
    const auto box_in = [](Scene& scene, double side, double height) {
        add_box(
            scene, boundary_of(medium_of(0.1, 0)), {-side, -side, -height}, {side, side, height},
            Facing::outward);
    };
    Scene nested = scene_named("nested");
    nested.environment = constant_environment(1);
    for (int k = 0; k < 5; ++k) box_in(nested, 1 - 0.1 * k, 1 - 0.1 * k);
    nested.primitives.back().name = "innermost";
    EXPECT_EQ(
        error_of(nested, perspective({0, 0, 4}, {0, 0, 0}, 1)),
        "nested: innermost lies inside 4 other media; at most 4 may lie around one another");

    for (const int bodies : {4, 5}) {
        SCOPED_TRACE(bodies);
        Scene crossing = scene_named("crossing");
        for (int k = 5 - bodies; k < 5; ++k) box_in(crossing, 1 - 0.05 * k, 1 + 0.05 * k);
        // its own light falls from the middle, in all media, on a square in the upper four
        add_square(crossing, lambert(grey(0.5F)), {0, 0, 1.04}, {0, 0, -1}, 0.2);
        add_square(crossing, lambert(grey(0), grey(1)), {0, 0, 0}, {0, 0, 1}, 0.2);
        const RenderSettings settings =
            square_settings("direct", orthographic({0, 0, 1.01}, {0, 0, 1.04}, 0.1), 8, 4);
        const RenderResult result = render(test_device(), crossing, settings);
        EXPECT_EQ(result.film.nonfinite.samples, bodies == 5 ? 8 * 8 * 4U : 0U);
        EXPECT_EQ(
            result.warnings, bodies == 4 ? std::vector<std::string>{}
                                         : std::vector<std::string>{
                                               "crossing: samples are not finite where more than 4 "
                                               "media lie around one another; take one of them "
                                               "away if any do"});
        // towards the fifth, by path
        const RenderResult path = render(
            test_device(), crossing,
            square_settings("path", orthographic({0, 0, 2}, {0.01, 0.5, 0}, 0.1), 8, 4));
        EXPECT_EQ(path.film.nonfinite.samples > 0, bodies == 5);
    }
}

TEST(MediaBoundary, ThatAnOrthographicCameraCutsIsRefused) {
    Scene scene = scene_named("cut");
    scene.environment = constant_environment(1);
    add_box(scene, boundary_of(medium_of(1, 0)), {-1, -1, -1}, {1, 1, 1}, Facing::outward);
    EXPECT_THROW(
        render(
            test_device(), scene,
            square_settings("mis", orthographic({0, 0, 0}, {0, 0, -1}, 3), 8, 4)),
        Error);
}

}  // namespace
}  // namespace wavepath
