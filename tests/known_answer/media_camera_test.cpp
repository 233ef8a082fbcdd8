// Cameras on the faces of bodies around media, and across them.
#include "scene/transform.h"
#include "support/media.h"
#include "support/rendering.h"
#include "support/temporary_folder.h"

#include <cmath>
#include <numbers>

namespace wavepath {
namespace {

// Floats do not say on which side of a face such a camera is.
TEST(MediaBoundary, RefusesACameraOnAFace) {
    Scene scene = scene_named("fog");
    scene.environment = constant_environment(1);
    add_box(scene, boundary_of(medium_of(0.5, 0)), {-1, -1, -1}, {1, 1, 1}, Facing::outward);
    scene.primitives[0].name = "box";
    const auto looks_out_from = [](double x, double y) {
        return perspective({x, y, 0}, {3, y, 0}, 1e-3);
    };
    for (const double x : {1.0, 1 - 5e-7, 1 + 5e-7})
        EXPECT_EQ(
            error_of([&] {
                render(test_device(), scene, square_settings("mis", looks_out_from(x, 0.2), 2, 1));
            }),
            "fog: the camera lies on a face of box, which encloses a medium: neither inside nor "
            "outside; move it by a millionth of the scene");
    const auto seen = [&](const Camera& camera) {
        return shared_mean(render_scene(scene, square_settings("mis", camera, 4, 4))).mean;
    };
    EXPECT_NEAR(seen(looks_out_from(1 - 2e-6, 0.2)), 1, 1e-5);
    EXPECT_NEAR(seen(looks_out_from(1 + 2e-6, 0.2)), 1, 1e-5);
    EXPECT_NEAR(seen(looks_out_from(1, 1.1)), 1, 1e-5) << "beside it, in its plane";
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

// A side that runs aslant past the film's rectangle, whose box it meets, does not cut it: within
// the medium, straight through to the face.
TEST(MediaBoundary, ThatPassesAFilmAslantCutsItNot) {
    constexpr double sigma = 0.7;
    for (const double side : {1.3, 1.6}) {  // of the film; 1.42 touches a side of the box
        Scene scene = scene_named("aslant");
        scene.environment = constant_environment(1);
        add_box(scene, boundary_of(medium_of(sigma, 0)), {-1, -1, -1}, {1, 1, 1}, Facing::outward);
        const double half = std::numbers::pi / 9;  // of a turn by 40 degrees
        scene.instances[0].to_world =
            compose({0, 0, 0}, {0, 0, std::sin(half), std::cos(half)}, {1, 1, 1});
        const RenderSettings settings =
            square_settings("mis", orthographic({0, 0, 0}, {0, 0, -1}, side), 8, 16);
        if (side < 1.42) {
            EXPECT_TRUE(has_mean(shared_mean(render_scene(scene, settings)), std::exp(-sigma)));
        } else {
            EXPECT_THROW(render(test_device(), scene, settings), Error);
        }
    }
}

}  // namespace
}  // namespace wavepath
