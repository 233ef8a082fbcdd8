// What lies far off must not show in the picture of what is close: a stray vertex, a sky dome, a
// ground to the horizon.
#include "support/media.h"
#include "support/rendering.h"
#include "support/sample_files.h"

#include "gltf/gltf_loader.h"
#include "scene/transform.h"

#include <cmath>
#include <functional>

namespace wavepath {
namespace {

namespace fs = std::filesystem;

// The same random numbers in both pictures: what differs is rounding, which turns a path here and
// there, so that they differ by much less than their noise.
void expect_same_picture(
    const RenderResult& a, const RenderResult& b, const std::string& what, double share = 0.25) {
    double squares = 0;
    double variances = 0;
    for (const char* channel : {"R", "G", "B"}) {
        const std::vector<float>& in_a = a.film.image.channels.at(channel);
        const std::vector<float>& in_b = b.film.image.channels.at(channel);
        const std::vector<float>& variance =
            a.film.image.channels.at(std::string("variance.") + channel);
        for (std::size_t i = 0; i < in_a.size(); ++i) {
            squares += std::pow(double{in_a[i]} - in_b[i], 2);
            variances += variance[i];
        }
    }
    EXPECT_GT(variances, 0) << what;
    EXPECT_LT(std::sqrt(squares), share * std::sqrt(variances))
        << what << ": RMSE " << std::sqrt(squares / variances) << " of the noise";
}

PunctualLight sun(const Vec3d& direction, float irradiance) {
    PunctualLight light;
    light.kind = LightKind::directional;
    light.direction = normalized(direction);
    light.intensity = grey(irradiance);
    return light;
}

// A wall, a picture 5 mm before it, and a floor; all black-and-white Lambertian and lit by a sun.
Scene stage() {
    Scene scene = scene_named("stage");
    add_square(scene, lambert(grey(0.8F), grey(0), true), {0, 1, 0}, {0, 0, 1}, 2);
    add_square(scene, lambert({0.8F, 0.1F, 0.1F}, grey(0), true), {0, 1, 0.005}, {0, 0, 1}, 1);
    add_square(scene, lambert(grey(0.8F), grey(0), true), {0, 0, 1}, {0, 1, 0}, 2);
    add_box(scene, lambert(grey(0.6F)), {-0.3, 0, 0.5}, {0, 0.3, 0.8}, Facing::outward);
    scene.lights.push_back(sun({1, -1, -1}, 3));
    return scene;
}

const Camera camera_at_stage = perspective({0.5, 1, 1.9}, {0, 0.7, 0}, 0.8);

RenderResult picture_of(const Scene& scene, const Camera& camera = camera_at_stage) {
    return render_scene(scene, square_settings("mis", camera, 32, 64));
}

TEST(FarGeometry, StrayTrianglesDoNotShow) {
    const RenderResult truth = picture_of(stage());
    for (const double distance : {1e4, 1e6, 1e8})
        for (const Vec3d& towards :
             {Vec3d{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}) {
            Scene scene = stage();
            const Vec3d at{
                distance * towards[0], distance * towards[1] + 0.001 * distance,
                distance * towards[2]};
            add_square(scene, lambert(grey(0)), at, {1, 2, 3}, 1);
            expect_same_picture(
                truth, picture_of(scene), fmt::format("at ({}, {}, {})", at[0], at[1], at[2]));
        }
}

// One vertex of a triangle on the stage is 1000 km off: a sliver from here to there.
TEST(FarGeometry, AStrayVertexDoesNotShow) {
    Scene scene = stage();
    add_triangles(
        scene, lambert(grey(0)), {0.6F, 0.5F, -0.01F, 0.7F, 0.5F, -0.01F, 4e5F, -5e5F, -1e6F},
        {0, 1, 2});
    expect_same_picture(picture_of(stage()), picture_of(scene), "sliver");
}

// Level, and at a slope that floats of its far corners do not hold.
TEST(FarGeometry, GroundsOfAnySizeLookAlike) {
    for (const Vec3d& normal : {Vec3d{0, 1, 0}, Vec3d{0.13, 1, 0.09}}) {
        const auto on_ground = [&](double size) {
            Scene scene = stage();
            scene.instances[0].to_world[13] +=
                0.5;  // the wall hovers over the ground, which it shades
            add_square(scene, lambert(grey(0.5F)), {0, -0.2, 0.5}, normal, size);
            return picture_of(scene, perspective({0.5, 1, 1.9}, {0.8, 0, 0.9}, 0.8));
        };
        const RenderResult near = on_ground(100);
        for (const double size : {1e4, 1e6, 1e7})
            expect_same_picture(near, on_ground(size), fmt::format("ground of {} m", size), 0.5);
    }
}

// A dome that emits is a sky of the same radiance, as far off as it may be.
TEST(FarGeometry, DomesLightAsSkiesDo) {
    Scene under_sky = stage();
    under_sky.environment = constant_environment(1);
    const Camera camera = perspective({0.5, 1, 1.9}, {0, 0.7, 0}, 1.6);
    const auto seen = [&](const Scene& scene) {
        return render_for(
            {.bias = 0.0035, .tests = 2}, scene, square_settings("mis", camera, 16, 64));
    };
    under_sky.lights.clear();
    const Estimate truth = image_mean(seen(under_sky));
    for (const double radius : {1e3, 1e6}) {
        Scene scene = under_sky;
        scene.environment.reset();
        add_icosphere(scene, lambert(grey(0), grey(1), true), {0, 0, 0}, radius, 3);
        EXPECT_TRUE(agree(image_mean(seen(scene)), truth, {.tests = 2})) << radius;
    }
}

// A lamp of 10 cm keeps its samples beside a ring of hills that glow a little.
TEST(FarGeometry, LampsKeepTheirSamples) {
    Scene scene = stage();
    scene.lights.clear();
    add_square(scene, lambert(grey(0), grey(100)), {0, 1.8, 1}, {0, -1, 0}, 0.1);
    const RenderResult truth = picture_of(scene);
    add_icosphere(scene, lambert(grey(0), grey(1e-4F), true), {0, 0, 0}, 1e6, 2);
    const RenderResult result = picture_of(scene);
    const auto mean_variance = [](const RenderResult& r) {
        double sum = 0;
        for (const float v : r.film.image.channels.at("variance.R")) sum += v;
        return sum;
    };
    EXPECT_LT(mean_variance(result), 3 * mean_variance(truth));
    EXPECT_TRUE(agree(image_mean(truth), image_mean(result), {.bias = 0.05}));
}

// Walls of 2 mm, on a ground of a thousand hills as wide as 200 km.
TEST(FarGeometry, GlassIsAsThinAsItIs) {
    const auto bubble = [](double hills) {
        Scene scene = scene_named("bubble");
        add_square(scene, lambert(grey(0.5F)), {0, 0, 0}, {0, 1, 0}, 0.6);
        add_icosphere(scene, glass(1.5), {0, 0.045, 0}, 0.04, 3);
        add_icosphere(scene, glass(1.5), {0, 0.045, 0}, 0.038, 3, Facing::inward);
        scene.instances[2].body = scene.instances[1].body;
        add_square(scene, lambert(grey(0), grey(3)), {0.1, 0.4, 0}, {0, -1, 0}, 0.4);
        const int cells = hills > 0 ? 24 : 0;
        for (int i = 0; i < cells; ++i)
            for (int j = 0; j < cells; ++j) {
                const double x = (i - cells / 2) * hills;
                const double z = (j - cells / 2) * hills;
                const double up = 0.1 * hills * ((7 * i + 5 * j) % 3);
                const bool here = i == cells / 2 && j == cells / 2;
                add_quad(
                    scene, lambert(grey(0)), {x, here ? -0.001 : -up - 0.01, z}, {0, 0, hills},
                    {hills, 0, 0});
            }
        RenderSettings settings =
            square_settings("mis", perspective({0.2, 0.15, 0.3}, {0, 0.04, 0}, 0.4), 32, 64);
        return render_scene(scene, settings);
    };
    expect_same_picture(bubble(0), bubble(8e3), "hills");
}

// A toy in a city that fills 10 km, whose houses are black: they do not show.
TEST(FarGeometry, AToyInACityIsAsSharpAsAlone) {
    const auto toy = [](bool in_city) {
        Scene scene = scene_named("toy");
        add_square(scene, lambert(grey(0.7F)), {0, 0, 0}, {0, 1, 0}, 0.3);
        add_box(
            scene, lambert({0.8F, 0.3F, 0.2F}), {-0.03, 2e-5, -0.03}, {0.03, 0.05, 0.03},
            Facing::outward);
        scene.lights.push_back(sun({0.4, -1, -0.3}, 2));
        for (int i = -12; in_city && i <= 12; ++i)
            for (int j = -12; j <= 12; ++j)
                if (i != 0 || j != 0)
                    add_box(
                        scene, lambert(grey(0)), {400. * i, -1, 400. * j},
                        {400. * i + 200, 20, 400. * j + 200}, Facing::outward);
        return picture_of(scene, perspective({0.15, 0.12, 0.2}, {0, 0.02, 0}, 0.5));
    };
    expect_same_picture(toy(false), toy(true), "city");
}

// Through a window of a room lies a glowing backdrop; far off it is a sky.
TEST(FarGeometry, BackdropsShineThroughWindows) {
    const auto room = [](double backdrop) {
        Scene scene = scene_named("room");
        const Material white = lambert(grey(0.7F), grey(0), true);
        add_square(scene, white, {0, 0, 0}, {0, 1, 0}, 4);
        add_square(scene, white, {0, 2, -2}, {0, 0, 1}, 4);
        add_square(scene, white, {-2, 2, 0}, {1, 0, 0}, 4);
        add_square(scene, white, {0, 4, 0}, {0, -1, 0}, 4);
        add_square(scene, white, {0, 2, 2}, {0, 0, -1}, 4);
        add_quad(scene, white, {2, 0, -2}, {0, 0, 4}, {0, 1.5, 0});  // below the window
        if (backdrop > 0)
            add_square(
                scene, lambert(grey(0), grey(2), true), {backdrop, 0, 0}, {-1, 0, 0},
                400 * backdrop);
        else
            scene.environment = constant_environment(2);
        return render_for(
            {.bias = 0.0035, .tests = 1}, scene,
            square_settings("mis", perspective({1.5, 2, 1.5}, {-2, 1.5, -2}, 0.9), 8, 256));
    };
    // the backdrop leaves out what is within .3 degrees of the horizon
    EXPECT_TRUE(agree(image_mean(room(1e5)), image_mean(room(0)), {.truth_error = 1.5e-3}));
}

// Fog in a far scene has the thickness that it has in a small one, seen from within a film too.
TEST(FarGeometry, FogIsAsThickAsItIs) {
    for (const double stray : {0., 1e6})
        for (const bool scatters : {false, true}) {
            Scene scene = scene_named("fog");
            scene.environment = constant_environment(1);
            const Medium fog = scatters ? medium_of(1.5, 1) : medium_of(1.5, 0);
            add_box(scene, boundary_of(fog), {-1, -1, -1}, {1, 1, 1}, Facing::outward);
            if (stray > 0) add_square(scene, lambert(grey(0)), {stray, 0, 0}, {0, 0, 1}, 1);
            const Camera camera = orthographic({0, 0, 1.9}, {0, 0, 0}, 0.5);
            const RenderResult result =
                render_for({.tests = 4}, scene, square_settings("mis", camera, 16, 64));
            EXPECT_TRUE(has_mean(shared_mean(result), scatters ? 1 : std::exp(-3), {.tests = 4}))
                << stray << ", scatters " << scatters;
        }
}

// The files of people's reports.
TEST(FarGeometry, FilesAreRenderedAsTheirPlainOnes) {
    const fs::path folder = asset_folder().parent_path() / "cases" / "huge-backdrop";
    if (!fs::is_directory(folder)) GTEST_SKIP() << "no folder of cases beside the checkout";
    const auto rendered = [&](const std::string& name, const Camera& camera, float sky) {
        Scene scene = load_gltf(folder / (name + ".gltf"));
        if (sky > 0) scene.environment = constant_environment(sky);
        return picture_of(scene, camera);
    };
    const Camera at_wall = perspective({0.3, 1, 1.9}, {0, 1, 0}, 0.785);
    const RenderResult plain = rendered("plain", at_wall, 0);
    for (const char* name :
         {"stray_100", "stray_1000", "stray_10000", "stray_100000", "stray_1e+06", "stray_1e+07"})
        expect_same_picture(plain, rendered(name, at_wall, 0), name);
    const RenderResult ground = rendered("ground_100", at_wall, 0);
    for (const char* name :
         {"ground_1000", "ground_10000", "ground_100000", "ground_1e+06", "ground_1e+07"})
        expect_same_picture(ground, rendered(name, at_wall, 0), name, 0.5);
    const Camera at_bubble = perspective({0.2, 0.15, 0.3}, {0, 0.04, 0}, 0.785);
    const RenderResult bubble = rendered("bubble_0", at_bubble, 1);
    for (const char* name : {"bubble_100", "bubble_1000", "bubble_10000"})
        expect_same_picture(bubble, rendered(name, at_bubble, 1), name);
}

}  // namespace
}  // namespace wavepath
