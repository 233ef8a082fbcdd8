// Cameras far from what they see: rounding of the eye and of directions must not show.
#include "support/rendering.h"

#include "scene/camera.h"
#include "scene/transform.h"

#include <gmock/gmock.h>

#include <cmath>

namespace wavepath {
namespace {

Scene table() {
    Scene scene = scene_named("table");
    add_square(scene, lambert(grey(0.7F)), {0, 0, 0}, {0, 0, 1}, 1.6);
    add_box(scene, lambert({0.8F, 0.3F, 0.2F}), {-0.4, -0.3, 0}, {0.1, 0.2, 0.5}, Facing::outward);
    add_box(scene, lambert(grey(0.4F)), {0.3, 0.1, 0}, {0.5, 0.3, 0.2}, Facing::outward);
    scene.environment = constant_environment(1);
    return scene;
}

constexpr uint32_t size = 32;  // of the pictures [pixels]
const Vec3d target{0.1, -0.05, 0.1};

Vec3d eye_at(double distance) {
    const Vec3d towards = normalized({0.5, -0.7, 0.6});
    return {
        target[0] + distance * towards[0], target[1] + distance * towards[1],
        target[2] + distance * towards[2]};
}

Camera tele(double distance) {
    return perspective(eye_at(distance), target, 2 * std::atan(1 / distance));
}

RenderResult picture_of(const Scene& scene, const Camera& camera) {
    return render_scene(scene, square_settings("mis", camera, size, 64));
}

// The same random numbers in both: pixels differ by rounding, at edges that samples fall across.
void expect_same_picture(const RenderResult& a, const RenderResult& b, const std::string& what) {
    double squares = 0;
    double variances = 0;
    const std::vector<float>& in_a = a.film.image.channels.at("R");
    const std::vector<float>& in_b = b.film.image.channels.at("R");
    for (std::size_t i = 0; i < in_a.size(); ++i) {
        squares += std::pow(double{in_a[i]} - in_b[i], 2);
        variances += a.film.image.channels.at("variance.R")[i];
    }
    EXPECT_LT(std::sqrt(squares), 0.1 * std::sqrt(variances)) << what;
}

void expect_depth(const RenderResult& result, double distance, const std::string& what) {
    const double depth = result.film.image.channels.at("depth.Z")[size * (size / 2) + size / 2];
    EXPECT_NEAR(depth, distance, 0.6 + 2e-7 * distance) << what;
}

TEST(FarCamera, SeesWhatAFilmSees) {
    const Scene scene = table();
    const RenderResult by_film = picture_of(scene, orthographic(eye_at(5), target, 2));
    for (const double distance : {1e5, 1e6, 1e9}) {
        const RenderResult by_eye = picture_of(scene, tele(distance));
        expect_same_picture(by_film, by_eye, fmt::format("eye {} m away", distance));
        expect_depth(by_eye, distance, "eye");
        const RenderResult far_film = picture_of(scene, orthographic(eye_at(distance), target, 2));
        expect_same_picture(by_film, far_film, fmt::format("film {} m away", distance));
        expect_depth(far_film, distance, "film");
    }
}

// With more of the scene behind, beside and before what is seen.
TEST(FarCamera, SeesSmallThingsInLargeScenes) {
    const RenderResult truth = picture_of(table(), orthographic(eye_at(5), target, 2));
    Scene scene = table();
    const Vec3d behind = eye_at(-1e6);
    add_square(scene, lambert(grey(0)), behind, {1, 1, 1}, 1);
    add_square(scene, lambert(grey(0)), {0, 0, 1e5}, {1, 1, 1}, 10);
    add_square(scene, lambert(grey(0)), {3e5, -2e5, -1e5}, {1, 1, 1}, 10);
    for (const double distance : {1e4, 1e5, 1e6}) {
        expect_same_picture(truth, picture_of(scene, tele(distance)), "eye");
        expect_same_picture(
            truth, picture_of(scene, orthographic(eye_at(distance), target, 2)), "film");
    }
}

// A plate at the edge of the view of an eye 40 times its size away, pixel by pixel: its depth is
// 40 over the cosine.
TEST(FarCamera, SeesWhatIsOffItsAxis) {
    Scene scene = scene_named("plate");
    add_square(scene, lambert(grey(0.5F)), {0, 0, 0}, {0, 0, 1}, 1);
    scene.environment = constant_environment(1);
    const Camera camera = perspective({0, 0, 40}, {6, 4, 0}, 0.5);
    constexpr uint32_t pixels = 256;
    const RenderResult result = render_scene(scene, square_settings("bsdf", camera, pixels, 4));
    const Vec3d x = axis(camera.to_world, 0);
    const Vec3d y = axis(camera.to_world, 1);
    const Vec3d back = axis(camera.to_world, 2);
    const double pixel = 2 * std::tan(0.25) / pixels;
    std::size_t seen = 0;
    for (uint32_t i = 0; i < pixels * pixels; ++i) {
        const double right = (i % pixels + 0.5 - pixels / 2.0) * pixel;
        const double up = (pixels / 2.0 - i / pixels - 0.5) * pixel;
        Vec3d d;
        for (std::size_t k = 0; k < 3; ++k) d[k] = right * x[k] + up * y[k] - back[k];
        const double t = 40 / -d[2];
        const double off = std::max(std::abs(t * d[0]), std::abs(t * d[1]));
        const float albedo = result.film.image.channels.at("albedo.R")[i];
        if (std::abs(off - 0.5) < 0.15) continue;  // the plate's edge is near
        EXPECT_EQ(albedo > 0, off < 0.5) << i;
        if (off > 0.5) continue;
        ++seen;
        EXPECT_NEAR(
            result.film.image.channels.at("depth.Z")[i] / (t * std::sqrt(dot(d, d))), 1, 4e-4);
    }
    EXPECT_GT(seen, 5U);
}

TEST(FarCamera, WarnsWherePixelsAreOne) {
    const Scene scene = table();
    const Camera narrow = perspective(eye_at(2), target, 1e-7);
    EXPECT_THAT(
        picture_of(scene, narrow).warnings,
        testing::Contains(testing::HasSubstr("does not tell the pixels of camera")));
    for (const Camera& camera : {tele(2), tele(1e6), orthographic(eye_at(1e6), target, 2)})
        EXPECT_TRUE(picture_of(scene, camera).warnings.empty());
}

}  // namespace
}  // namespace wavepath
