#include "prepare/placement.h"

#include "build_paths.h"
#include "gltf/gltf_loader.h"
#include "prepare/view.h"
#include "scene/camera.h"
#include "scene/transform.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

namespace wavepath {
namespace {

Scene object() {
    Scene scene = scene_named("object");
    add_box(scene, lambert(grey(0.5F)), {-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}, Facing::outward);
    return scene;
}

Scene with_stray(const Vec3d& at) {
    Scene scene = object();
    add_square(scene, lambert(grey(0.5F)), at, at, 1);
    return scene;
}

PlacedScene placed(const Scene& scene, const Camera& camera) {
    return place(scene, camera, 64, 64);
}

// About the object, of which a picture shows `metres`: rays leave it at most 2^-17 of that off.
void expect_subject(const PlacedScene& scene, double metres) {
    const Extent& extent = scene.geometry.extent;
    const double away = std::hypot(extent.centre[0], extent.centre[1], extent.centre[2]);
    EXPECT_LT(std::max(extent.metres, 2 * away), 8 * metres);
    EXPECT_GT(extent.metres, metres / 4);
}

TEST(Placement, OfTheScenesHereIsTheirBoundingBox) {
    std::size_t scenes = 0;
    for (const auto& entry : std::filesystem::directory_iterator(WAVEPATH_SOURCE_DIR "/scenes")) {
        const auto path = entry.path() / "scene.gltf";
        if (!std::filesystem::exists(path)) continue;
        ++scenes;
        const Scene scene = load_gltf(path);
        const PlacedScene result = placed(scene, choose_camera(scene, ""));
        const Extent box = extent_of(scene);
        EXPECT_EQ(result.geometry.extent.metres, box.metres) << path;
        EXPECT_EQ(result.geometry.extent.centre, box.centre) << path;
        EXPECT_FALSE(result.geometry.is_far()) << path;
        EXPECT_EQ(result.free_distance, 0) << path;
    }
    EXPECT_GE(scenes, 9U);
}

TEST(Placement, IsAboutWhatIsSeenOfASceneWithAStrayTriangle) {
    const Camera camera = perspective({2, 1, 2}, {0, 0, 0}, 0.6);
    for (const double distance : {1e3, 1e4, 1e6, 1e7})
        for (const Vec3d& towards :
             {Vec3d{1, 0, 0},
              {-1, 0, 0},
              {0, 1, 0},
              {0, -1, 0},
              {0, 0, 1},
              {0, 0, -1},
              {1, -1, 1}}) {
            SCOPED_TRACE(distance);
            const PlacedScene result = placed(
                with_stray({distance * towards[0], distance * towards[1], distance * towards[2]}),
                camera);
            expect_subject(result, 1.8);
            EXPECT_TRUE(result.geometry.is_far());
            EXPECT_TRUE(result.warnings.empty());
        }
}

// Whatever stands behind it, and however little of the picture it fills.
TEST(Placement, IsAboutTheFinestThatIsSeen) {
    Scene scene = object();
    add_icosphere(scene, lambert(grey(0.5F)), {0, 0, 0}, 1e5, 3, Facing::inward);
    add_square(scene, lambert(grey(0.5F)), {0, -0.5, 0}, {0, 1, 0}, 1e6);
    expect_subject(placed(scene, perspective({2, 1, 2}, {0, 0, 0}, 0.6)), 1.8);
    expect_subject(placed(scene, perspective({2, 1, 2}, {1, 0, -1}, 1.2)), 3);
    expect_subject(placed(scene, orthographic({2, 1, 2}, {0, 0, 0}, 5)), 5);
    expect_subject(placed(scene, perspective({3e4, 1e4, 3e4}, {0, 0, 0}, 1e-4)), 4);
}

TEST(Placement, OfTheWholeIsTheWhole) {
    const Scene scene = with_stray({1e6, 0, 0});
    const Camera camera = choose_camera(scene, "");
    EXPECT_EQ(placed(scene, camera).geometry.extent.metres, extent_of(scene).metres);
}

TEST(Placement, WarnsOfWhatIsLost) {
    const Camera camera = perspective({2, 1, 2}, {0, 0, 0}, 0.6);
    const Scene scene = with_stray({3e10, 0, 0});
    const PlacedScene result = placed(scene, camera);
    EXPECT_TRUE(result.geometry.is_far());
    ASSERT_EQ(result.warnings.size(), 1U);
    EXPECT_NE(result.warnings[0].find("too large for what the camera sees"), std::string::npos);
}

TEST(FreeDistance, IsThatOfTheNearestInView) {
    Scene scene = scene_named("views");
    add_square(scene, lambert(grey(1)), {0, 0, 0}, {0, 0, 1}, 2);
    add_square(scene, lambert(grey(1)), {50, 0, 500}, {0, 0, 1}, 1);  // beside the view
    const NormalisedScene geometry = normalise(scene, Extent{{0, 0, 0}, 1});
    const Bvh bvh = build_bvh(geometry.positions);
    const auto free = [&](const Camera& camera) {
        return free_distance(view_of(camera, geometry, 64, 64), geometry, bvh);
    };
    EXPECT_NEAR(free(perspective({0, 0, 1000}, {0, 0, 0}, 1e-3)), 1000, 0.2);
    EXPECT_NEAR(free(perspective({0, 0, 1000}, {0, 0, 0}, 0.5)), 500, 0.1);
    EXPECT_NEAR(free(orthographic({0, 0, 1000}, {0, 0, 0}, 3)), 1000, 0.2);
    EXPECT_NEAR(free(orthographic({0, 0, 1000}, {0, 0, 0}, 120)), 500, 0.1);
    EXPECT_TRUE(std::isinf(free(perspective({0, 0, 1000}, {0, 0, 2000}, 0.5)))) << "behind it";
    // a ground below the eye: where the lowest ray of the view meets it
    Scene ground = scene_named("ground");
    add_square(ground, lambert(grey(1)), {0, -1, 0}, {0, 1, 0}, 1e5);
    const NormalisedScene flat = normalise(ground, Extent{{0, 0, 0}, 1});
    const double nearest = free_distance(
        view_of(perspective({0, 0, 100}, {0, 0, 0}, 2 * std::atan(0.1)), flat, 64, 64), flat,
        build_bvh(flat.positions));
    EXPECT_NEAR(nearest, 10, 0.02);
}

}  // namespace
}  // namespace wavepath
