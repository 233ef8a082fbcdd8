// Media at the ends of their ranges, and the same bytes however the work is divided.
#include "support/media.h"
#include "support/rendering.h"

#include <cstring>

namespace wavepath {
namespace {

Scene slab(const Medium& medium, double half_width) {
    Scene scene = scene_named("slab");
    scene.environment = constant_environment(1);
    add_slab(scene, medium, half_width);
    return scene;
}

const Camera above = along(1);

// Nothing is cut: a plate that only scatters gives back all that falls on it. The longest paths
// take some 10^4 scatterings.
TEST(MediaStability, DensePlateLosesNothing) {
    const struct { double tau, g; } plates[] = {{100, 0}, {100, 0.9999}, {100, -0.9999}};
    for (const Distances distances :
         {Distances::exponential, Distances::truncated, Distances::equiangular, Distances::mis})
        for (const auto& [tau, g] : plates) {
            RenderSettings settings = square_settings("path", above, 8, 4);
            settings.method.distances = distances;
            const RenderResult result = render_scene(slab(medium_of(tau, 1, g), 10), settings);
            EXPECT_NEAR(shared_mean(result).mean, 1, 1e-3) << name_of(distances) << ", g " << g;
        }
}

// The notes' uniform distances have weights there that no number of samples tames: no mean to test,
// but nothing hangs, and nothing is no number.
TEST(MediaStability, DensePlateByUniformDistancesIsFinite) {
    for (const double g : {0.0, 0.9999, -0.9999}) {
        RenderSettings settings = square_settings("path", above, 8, 4);
        settings.method.distances = Distances::uniform;
        const RenderResult result = render_scene(slab(medium_of(100, 1, g), 10), settings);
        EXPECT_EQ(result.film.nonfinite.samples, 0U) << g;
    }
}

// Peaks and lamps together, where weights are largest: finite all the same.
TEST(MediaStability, PeaksBeforeLampsAreFinite) {
    for (const double g : {0.9999, -0.9999})
        for (const Distances distances :
             {Distances::exponential, Distances::uniform, Distances::truncated,
              Distances::equiangular, Distances::mis})
            for (const bool phase_directions : {true, false}) {
                Scene scene = slab(medium_of(10, 0.9, g), 2);
                add_square(scene, lambert(grey(0), grey(10)), {0.1, 0.03, 1}, {0, 0, -1}, 0.1);
                PunctualLight light;
                light.position = {0.1, 0.03, -0.1};  // in the medium
                scene.lights.push_back(light);
                RenderSettings settings = square_settings(
                    "mis", perspective({0.3, 0.2, 0.5}, {0.1, 0.03, 0}, 0.5), 16, 16);
                settings.method.distances = distances;
                settings.method.phase_directions = phase_directions;
                const RenderResult result = render_scene(scene, settings);
                EXPECT_EQ(result.film.nonfinite.samples, 0U)
                    << name_of(distances) << ", g " << g << ", " << phase_directions;
                EXPECT_GT(image_mean(result).mean, 0);
            }
}

// 10^4 and 10^5 free paths across the scene: at 10^5 one is 170 times what positions are rounded
// to.
TEST(MediaStability, OpaquePlateReflectsAsAHalfSpace) {
    for (const double sigma_t : {1e4, 1e5}) {
        Scene scene = slab(medium_of(sigma_t, 0.9), 0.5);
        const Strictness strictness{.tests = 2};
        const RenderResult result =
            render_for(strictness, scene, square_settings("mis", above, 16, 256));
        EXPECT_TRUE(has_mean(shared_mean(result), .41494748, strictness)) << sigma_t;
    }
}

// The same in a face of glass, where rays start some way behind it.
TEST(MediaStability, OpaquePlateOfGlassReflectsLikeAThinnerOne) {
    const auto reflected = [&](double sigma_t) {
        Scene scene = slab(medium_of(sigma_t, 0.9), 0.5);
        scene.materials[0].boundary = Boundary::dielectric;
        scene.materials[0].ior = 1.5F;
        return shared_mean(
            render_for({.bias = 0.01 / 1.5}, scene, square_settings("mis", above, 16, 256)));
    };
    EXPECT_TRUE(agree(reflected(1e5), reflected(300), {.bias = 0.01}));
}

TEST(MediaStability, SmallAnisotropyIsNone) {
    for (const double g : {1e-6, -1e-6}) {
        const RenderResult result =
            render_for({}, slab(medium_of(1, 0.9, g), 40), square_settings("mis", above, 16, 256));
        EXPECT_TRUE(has_mean(shared_mean(result), .26741034 + .59162509, {.truth_error = 2e-6}))
            << g;
    }
}

// A room of fog with a ball of another medium in it; the camera is in the fog.
Scene foggy_room() {
    Scene scene = scene_named("foggy room");
    add_box(scene, lambert({0.7F, 0.5F, 0.4F}), {-1, -1, -1}, {1, 1, 1}, Facing::inward);
    add_square(scene, lambert(grey(0), grey(6)), {0, 0.9, 0}, {0, -1, 0}, 0.8);
    Medium fog = medium_of(0.8, 0.9, 0.5);
    fog.sigma_a = {0.3F, 0.1F, 0};
    add_box(scene, boundary_of(fog), {-1.1, -1.1, -1.1}, {1.1, 1.1, 1.1}, Facing::outward);
    add_icosphere(scene, boundary_of(medium_of(8, 0.99, -0.3)), {-0.3, -0.3, 0}, 0.4, 2);
    return scene;
}

const Camera in_the_fog = perspective({0.8, 0.2, 0.9}, {-0.2, -0.4, -0.3}, 1.2);

// Lengths times k, coefficients over k: a similar scene, and the same random numbers. What differs
// is rounding, which turns a path here and there.
TEST(MediaStability, SimilarMediaLookAlike) {
    const auto render_at = [](double scale, const Vec3d& shift) {
        Scene scene = foggy_room();
        Camera camera = in_the_fog;
        transform(scene, camera, scale, shift);
        return render_scene(scene, square_settings("mis", camera, 32, 64));
    };
    const std::vector<float> home = render_at(1, {0, 0, 0}).film.image.channels.at("R");
    const double mean = estimate_of({home.begin(), home.end()}).mean;
    const std::pair<double, Vec3d> places[] = {
        {1e-4, {0, 0, 0}}, {1e4, {0, 0, 0}}, {1, {1e3, -1e3, 1e3}}};
    for (const auto& [scale, shift] : places) {
        const std::vector<float> there = render_at(scale, shift).film.image.channels.at("R");
        std::vector<double> ratios;
        for (std::size_t i = 0; i < home.size(); ++i)
            ratios.push_back(1 + (there[i] - home[i]) / mean);
        EXPECT_TRUE(has_mean(estimate_of(ratios), 1, {.tests = std::size(places)}))
            << scale << ", " << shift[0];
    }
}

void expect_same(const RenderResult& a, const RenderResult& b) {
    for (const auto& [name, plane] : a.film.image.channels)
        EXPECT_EQ(
            std::memcmp(
                plane.data(), b.film.image.channels.at(name).data(), plane.size() * sizeof(float)),
            0)
            << name;
}

TEST(MediaStability, SameBytesOfRunsPoolsAndWorkGroups) {
    // 37 x 23 pixels of 13 samples: nothing divides evenly
    RenderSettings settings = square_settings("mis", in_the_fog, 37, 13);
    settings.height = 23;
    const RenderResult first = render_scene(foggy_room(), settings);
    expect_same(first, render_scene(foggy_room(), settings));
    for (const uint32_t pool : {300U, 200000U}) {
        SCOPED_TRACE(pool);
        settings.pool = pool;
        expect_same(first, render_scene(foggy_room(), settings));
    }
    settings.work_groups = {16, 64};
    expect_same(first, render_scene(foggy_room(), settings));
}

// The same where segments and stops branch, and where counts come late, as on a GPU.
TEST(MediaStability, SameBytesOfPoolsWithSplits) {
    RenderSettings settings = square_settings("mis", in_the_fog, 37, 5);
    settings.height = 23;
    settings.method.distances = Distances::mis;
    settings.splits = {2, 2, 2};
    settings.split_depth = 2;
    const RenderResult first = render_scene(foggy_room(), settings);
    for (const uint32_t pool : {300U, 200000U}) {
        SCOPED_TRACE(pool);
        settings.pool = pool;
        expect_same(first, render_scene(foggy_room(), settings));
    }
    settings.pool = 1000;
    settings.count_lag = 1;
    const RenderResult late = render_scene(foggy_room(), settings);
    expect_same(first, late);
    EXPECT_EQ(first.rays.closest, late.rays.closest);
    EXPECT_EQ(first.rays.connections, late.rays.connections);
}

// The same with glass in the fog, smooth and rough, with a liquid between two pieces of it, and all
// on the floor.
TEST(MediaStability, SameBytesOfGlassThatTouches) {
    Scene scene = foggy_room();
    Material rough = glass(1.5);
    rough.roughness = 0.4F;
    const Material liquid = glass(1.33, medium_of(1, 0.5));
    add_box(scene, glass(1.5), {-0.1, -1, 0}, {0.5, -0.6, 0.5}, Facing::outward);
    add_box(scene, liquid, {-0.1, -0.6, 0}, {0.5, -0.4, 0.5}, Facing::outward);
    add_box(scene, rough, {-0.1, -0.4, 0}, {0.5, -0.35, 0.5}, Facing::outward);
    add_icosphere(scene, rough, {-0.5, -0.75, 0.5}, 0.25, 2);
    RenderSettings settings = square_settings("mis", in_the_fog, 37, 2);
    settings.height = 23;
    settings.method.distances = Distances::mis;
    settings.splits = {2, 2, 2};
    settings.split_depth = 2;
    const RenderResult first = render_scene(scene, settings);
    settings.pool = 300;
    expect_same(first, render_scene(scene, settings));
    settings.pool = 0;
    settings.work_groups = {16, 64};
    expect_same(first, render_scene(scene, settings));
}

}  // namespace
}  // namespace wavepath
