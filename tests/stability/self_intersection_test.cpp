// Rays that start on a surface: none may meet it again, none may skip what is close.
#include "support/rendering.h"

#include <algorithm>
#include <cmath>

namespace wavepath {
namespace {

// A convex body of albedo .5 in a uniform environment without roulette: every sample is .5, and .25
// or less if its ray meets the body again. So one self-intersection among all samples shows.
void expect_half_everywhere(Scene scene, const Camera& camera, const std::string& what) {
    SCOPED_TRACE(what);
    scene.environment = constant_environment(1);
    for (const char* method : {"bsdf", "direct"}) {
        RenderSettings settings = square_settings(method, camera, 64, 64);
        settings.termination = {TerminationKind::zero, 0, 1};
        const RenderResult result = render_scene(scene, settings);
        if (std::string(method) == "bsdf") {
            const std::vector<float>& pixels = result.film.image.channels.at("R");
            EXPECT_EQ(
                std::ranges::count_if(pixels, [](float x) { return std::abs(x - 0.5F) > 1e-6F; }),
                0);
        } else {
            EXPECT_TRUE(has_mean(shared_mean(result), 0.5, {.bias = 0.02}));
        }
    }
}

TEST(SelfIntersection, NoneOnConvexBodies) {
    const struct {
        double scale;
        Vec3d shift;
    } cases[] = {
        {1, {0, 0, 0}},
        {1, {1e3, 1e3, 1e3}},
        {1e-4, {0, 0, 0}},
        {1e4, {0, 0, 0}},
        {1, {1e6, 0, 0}}};
    for (const auto& [scale, shift] : cases) {
        const std::string where = fmt::format("scale {}, shift {}", scale, shift[0]);
        Scene box = scene_named("box");
        add_box(box, lambert(grey(0.5F)), {-1, -0.7, -0.4}, {1, 0.7, 0.4}, Facing::outward);
        Camera camera = orthographic({3, 2, 2.5}, {0, 0, 0}, 0.6);
        transform(box, camera, scale, shift);
        expect_half_everywhere(box, camera, "box, " + where);

        Scene ball = scene_named("ball");
        add_icosphere(ball, lambert(grey(0.5F)), {0, 0, 0}, 1, 4);
        camera = orthographic({3, 2, 2.5}, {0, 0, 0}, 1.3);
        transform(ball, camera, scale, shift);
        expect_half_everywhere(ball, camera, "ball, " + where);
    }
}

// A body far off the centre of a scene a thousand times its size: its coordinates have the fewest
// digits.
TEST(SelfIntersection, NoneOnASmallBodyInALargeScene) {
    Scene scene = scene_named("small body");
    add_icosphere(scene, lambert(grey(0.5F)), {999, 0, 0}, 1, 4);
    add_box(scene, lambert(grey(0)), {-1000, -0.01, -0.01}, {-999.99, 0.01, 0.01}, Facing::outward);
    expect_half_everywhere(scene, orthographic({1002, 2, 2.5}, {999, 0, 0}, 1.3), "small body");
}

// A cube whose faces are fans of slivers, with triangles of no area and others that lie there
// twice.
TEST(SelfIntersection, NoneWithSliversAndDuplicates) {
    Scene scene = scene_named("slivers");
    std::vector<float> positions;
    std::vector<uint32_t> indices;
    const auto face = [&](int axis, float side) {
        const auto point = [&](float a, float b) {
            const float p[3] = {side, a, b};
            for (int k = 0; k < 3; ++k) positions.push_back(p[(k + 3 - axis) % 3]);
            return static_cast<uint32_t>(positions.size() / 3 - 1);
        };
        const auto triangle = [&](uint32_t a, uint32_t b, uint32_t c) {
            indices.insert(indices.end(), {a, side > 0 ? b : c, side > 0 ? c : b});
        };
        // strips of height 1e-6, 1e-5, ... across the face, each cut along its diagonal; their ends
        // are T-junctions on the cube's edges, where nothing keeps rays out: the camera looks at
        // the middle of a face
        float low = -1;
        for (const float high :
             {-0.3F, -0.3F + 1e-6F, -0.3F + 1e-5F, 0.0F, 1e-5F, 0.3F, 0.3F + 1e-4F, 1.0F}) {
            const uint32_t a = point(-1, low);
            const uint32_t b = point(1, low);
            const uint32_t c = point(1, high);
            const uint32_t d = point(-1, high);
            triangle(a, b, c);
            triangle(a, c, d);
            triangle(a, b, c);
            triangle(a, b, b);
            triangle(a, c, a);
            low = high;
        }
    };
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {-1.0F, 1.0F}) face(axis, side);
    add_triangles(scene, lambert(grey(0.5F)), positions, indices);
    expect_half_everywhere(scene, orthographic({3, 0.3, 0.4}, {1, 0, 0}, 0.9), "slivers");
    scene.environment = constant_environment(1);
    const RenderResult result = render_scene(
        scene, square_settings("bsdf", orthographic({3, 0.3, 0.4}, {1, 0, 0}, 0.9), 8, 1));
    EXPECT_GE(result.dropped_triangles, 6U * 8 * 2);
}

// Two plates 4e-5 of their width apart: what lies between them sees the other plate and nothing
// else. 4e-5 is some forty of the offsets with which rays leave a surface.
TEST(ThinGap, LetsNoLightIn) {
    constexpr double gap = 4e-5;
    Scene scene = scene_named("thin gap");
    add_square(scene, lambert(grey(1)), {0, 0, 0}, {0, 0, 1}, 1);
    add_square(scene, lambert(grey(0)), {0, 0, gap}, {0, 0, -1}, 1);
    scene.environment = constant_environment(1);
    const Camera camera = close_up({0.1, 0.05, 0}, {0, 0, 1}, gap / 2, 0.1);
    for (const char* method : {"bsdf", "direct"}) {
        SCOPED_TRACE(method);
        // the open rim is gap^2 / .16 = 1e-8 of the projected solid angle
        EXPECT_LT(
            shared_mean(render_scene(scene, square_settings(method, camera, 64, 64))).mean, 1e-6);
    }
}

TEST(ThinGap, IsCrossed) {
    constexpr double gap = 4e-5;
    Scene scene = scene_named("thin gap");
    add_square(scene, lambert(grey(1)), {0, 0, 0}, {0, 0, 1}, 1);
    add_square(scene, lambert(grey(0), grey(1)), {0, 0, gap}, {0, 0, -1}, 1);
    const Camera camera = close_up({0.1, 0.05, 0}, {0, 0, 1}, gap / 2, 0.1);
    for (const char* method : {"bsdf", "mis"}) {
        SCOPED_TRACE(method);
        EXPECT_TRUE(
            has_mean(shared_mean(render_scene(scene, square_settings(method, camera, 64, 64))), 1));
    }
}

}  // namespace
}  // namespace wavepath
