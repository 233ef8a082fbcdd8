// The layers of what a camera ray meets first.
#include "support/media.h"
#include "support/rendering.h"

#include <algorithm>
#include <cmath>

namespace wavepath {
namespace {

// A wall 2.5 units before the camera whose right half is cut away, at three scales.
TEST(FirstHit, DepthIsInMetresAlongTheRay) {
    constexpr uint32_t size = 16;
    constexpr double distance = 2.5;
    for (const double scale : {1.0, 1e-3, 1e4}) {
        SCOPED_TRACE(scale);
        Scene scene = scene_named("half a wall");
        add_quad(scene, lambert({0.2F, 0.4F, 0.6F}), {-20, -20, -distance}, {20, 0, 0}, {0, 40, 0});
        scene.environment = constant_environment(1);
        Camera camera = perspective({0, 0, 0}, {0, 0, -1}, 2 * std::atan(0.5));
        transform(scene, camera, scale, {3 * scale, 0, 0});
        const Image image = render_scene(scene, square_settings("mis", camera, size, 4)).film.image;
        // along an axis of the picture, of the point at `pixels` from its corner
        const auto slope = [](double pixels) { return (pixels / size - 0.5); };
        for (uint32_t y = 0; y < size; ++y) {
            for (uint32_t x = 0; x < size; ++x) {
                const std::size_t pixel = std::size_t{y} * size + x;
                const float depth = image.channels.at("depth.Z")[pixel];
                if (x >= size / 2) {
                    EXPECT_EQ(depth, 0);
                    EXPECT_EQ(image.channels.at("normal.Z")[pixel], 0);
                    continue;
                }
                const double near_x = slope(x + 1);
                const double far_x = slope(x);
                const double near_y = std::min(std::abs(slope(y)), std::abs(slope(y + 1)));
                const double far_y = std::max(std::abs(slope(y)), std::abs(slope(y + 1)));
                EXPECT_GT(depth, 0.99999 * scale * distance * std::hypot(1, near_x, near_y));
                EXPECT_LT(depth, 1.00001 * scale * distance * std::hypot(1, far_x, far_y));
                EXPECT_NEAR(image.channels.at("normal.Z")[pixel], 1, 1e-6);
                EXPECT_NEAR(image.channels.at("albedo.G")[pixel], 0.4, 1e-6);
            }
        }
    }
}

// A pixel half covered by a wall lies as deep as the wall.
TEST(FirstHit, DepthIsTheMeanOfTheRaysThatHit) {
    Scene scene = scene_named("edge in a pixel");
    add_quad(scene, lambert(grey(0.5F)), {-20, -20, -2}, {20, 0, 0}, {0, 40, 0});
    scene.environment = constant_environment(1);
    const Image image =
        render_scene(scene, square_settings("mis", orthographic({0, 0, 0}, {0, 0, -1}, 1), 1, 64))
            .film.image;
    EXPECT_NEAR(image.channels.at("depth.Z")[0], 2, 1e-5);
    EXPECT_NEAR(image.channels.at("normal.Z")[0], 0.5, 0.05);
}

// Through a fog that only absorbs, and a hollow in it, to a wall; of glass its face. Where light
// scatters first, nothing.
TEST(FirstHit, IsSeenThroughMatchedMedia) {
    const auto layers = [](const Material& boundary) {
        Scene scene = scene_named("wall");
        scene.environment = constant_environment(1);
        add_quad(scene, lambert({0.2F, 0.4F, 0.6F}), {-20, -20, -3}, {40, 0, 0}, {0, 40, 0});
        add_box(scene, boundary, {-2, -2, -2}, {2, 2, -0.5}, Facing::outward);
        add_box(scene, boundary, {-1, -1, -1.5}, {1, 1, -1}, Facing::inward);
        return render_scene(
                   scene, square_settings("mis", orthographic({0, 0, 0}, {0, 0, -1}, 1), 4, 16))
            .film.image;
    };
    const Image through = layers(boundary_of(medium_of(1, 0)));
    const Image glassy = layers(glass(1.5));
    const Image dense = layers(boundary_of(medium_of(1e3, 0.5)));
    for (std::size_t pixel = 0; pixel < 16; ++pixel) {
        EXPECT_NEAR(through.channels.at("depth.Z")[pixel], 3, 1e-5);
        EXPECT_NEAR(through.channels.at("albedo.G")[pixel], 0.4, 1e-6);
        EXPECT_NEAR(through.channels.at("normal.Z")[pixel], 1, 1e-6);
        EXPECT_NEAR(glassy.channels.at("depth.Z")[pixel], 0.5, 1e-5);
        EXPECT_NEAR(glassy.channels.at("albedo.G")[pixel], 1, 1e-6);
        EXPECT_EQ(dense.channels.at("depth.Z")[pixel], 0);
        EXPECT_EQ(dense.channels.at("albedo.G")[pixel], 0);
    }
}

}  // namespace
}  // namespace wavepath
