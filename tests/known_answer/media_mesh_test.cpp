// Meshes around media as files have them: holes, seams, hollows, twins, too many of them.
#include "support/media.h"
#include "support/rendering.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <random>

namespace wavepath {
namespace {

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
    for (const std::size_t i : ball.indices) {
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
    EXPECT_NEAR(shared_mean(result).mean, 1, 1e-6);
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
        "shell: inner is inside out, and no hollow in a body of the same medium; turn its faces");
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

    Scene hollow = scene_named("hollow");
    hollow.environment = constant_environment(1);
    for (int k = 0; k < 3; ++k) box_in(hollow, 1 - 0.1 * k, 1 - 0.1 * k);
    const Material core = boundary_of(medium_of(0.5, 0));
    add_box(hollow, core, {-.7, -.7, -.7}, {.7, .7, .7}, Facing::outward);
    add_box(hollow, core, {-.2, -.2, -.2}, {.2, .2, .2}, Facing::inward);
    const RenderResult through = render_scene(
        hollow, square_settings("mis", orthographic({0.1, 0.15, 3}, {0.1, 0.15, 0}, 0.01), 4, 4));
    EXPECT_NEAR(shared_mean(through).mean / std::exp(-0.5 * 1 - 0.1 * 1), 1, 1e-5);

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
                                               "media lie around one another, or meet in a plane; "
                                               "take one of them away if any do"});
        // towards the fifth, by path
        const RenderResult path = render(
            test_device(), crossing,
            square_settings("path", orthographic({0, 0, 2}, {0.01, 0.5, 0}, 0.1), 8, 4));
        EXPECT_EQ(path.film.nonfinite.samples > 0, bodies == 5);
    }
}

}  // namespace
}  // namespace wavepath
