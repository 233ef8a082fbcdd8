// Ways to choose stops in a medium: one mean, and the variances that quadrature predicts where both
// terms of a segment are taken.
#include "support/media.h"
#include "support/rendering.h"

#include <cmath>
#include <numbers>

namespace wavepath {
namespace {

constexpr double footprint = 1e-5;

// A point light in a medium at `height` from a ray that passes it half way and ends at a black
// wall. Single scattering, times 4 pi / sigma_s: the integral of exp(-sigma (t + r)) / r^2.
struct Airlight {
    double sigma, height, integral, length = 10;

    Scene scene() const {
        Scene s = scene_named("airlight");
        add_box(
            s, boundary_of(medium_of(sigma, 1)), {-40, -40, -40}, {40, 40, 40}, Facing::outward);
        add_square(s, lambert(grey(0)), {0, 0, -length}, {0, 0, 1}, 1);
        PunctualLight light;
        light.position = {height, 0, -0.5 * length};
        s.lights.push_back(light);
        return s;
    }

    double radiance() const { return sigma / (4 * std::numbers::pi) * integral; }

    RenderSettings settings(Distances distances, uint32_t size, uint64_t samples) const {
        RenderSettings settings =
            square_settings("mis", orthographic({0, 0, 0}, {0, 0, -1}, footprint), size, samples);
        settings.termination = {TerminationKind::depth, 1, 1};
        settings.method.distances = distances;
        settings.sobol = false;
        return settings;
    }
};

constexpr Airlight near_thin{0.1, 0.1, 18.304568};
constexpr Airlight near_dense{1, 0.1, .17262769};
constexpr Airlight far_dense{1, 2, .0016234465};
constexpr Airlight nearest{0.5, 0.01, 68.745819083898, 6};

TEST(MediaDistance, HasThePredictedVarianceAboutAPointLight) {
    const struct {
        const Airlight& airlight;
        Distances distances;
        double relative_variance;
    } cases[] = {
        {near_thin, Distances::uniform, 15.8173},
        {near_thin, Distances::truncated, 16.5245},
        {near_thin, Distances::equiangular, .00352599},
        {near_thin, Distances::mis, .713022},
        {near_dense, Distances::uniform, 17.9077},
        {near_dense, Distances::equiangular, .0649303},
        {near_dense, Distances::mis, 1.04344},
        {far_dense, Distances::uniform, .826229},
        {far_dense, Distances::truncated, 6.85839},
        {far_dense, Distances::equiangular, .97311},
        {far_dense, Distances::mis, .879134}};
    for (const auto& [airlight, distances, relative_variance] : cases) {
        SCOPED_TRACE(fmt::format(
            "sigma {}, height {}, {}", airlight.sigma, airlight.height, name_of(distances)));
        const RenderResult result =
            render_scene(airlight.scene(), airlight.settings(distances, 256, 1));
        const double mean = airlight.radiance();
        EXPECT_TRUE(has_mean(
            sample_variance(result), relative_variance * mean * mean,
            {.bias = 0.2, .tests = std::size(cases)}));
        EXPECT_TRUE(has_mean(
            shared_mean(result), mean,
            {.bias = 0.15, .tests = std::size(cases), .truth_error = 2e-5}));
    }
}

// So thin that nothing is extinguished: 1 / r^2 alone, whose integral is 2 atan(1 / D) / D. Stops
// alike for all of the ray die by 1 / (pi D), equiangular ones have the integrand's own density.
TEST(MediaDistance, HasThePredictedVarianceWhereNothingIsExtinguished) {
    const struct {
        double height, relative_variance;
        uint32_t size;
    } cases[] = {
        {1, .041904507, 256},
        {0.1, 2.6274963, 256},
        {0.01, 31.240149, 512},
        {1e-3, 317.71556, 1280}};
    constexpr double sigma = 1e-4;
    for (const auto& [height, relative_variance, size] : cases) {
        SCOPED_TRACE(height);
        const Airlight airlight{sigma, height, 2 * std::atan(1 / height) / height, 2};
        const double mean = airlight.radiance();
        const Strictness strictness{
            .bias = 0.2, .tests = std::size(cases), .truth_error = 4 * sigma};
        const RenderResult even =
            render_scene(airlight.scene(), airlight.settings(Distances::uniform, size, 1));
        EXPECT_TRUE(has_mean(sample_variance(even), relative_variance * mean * mean, strictness));
        const RenderResult aimed =
            render_scene(airlight.scene(), airlight.settings(Distances::equiangular, 256, 1));
        // and what the footprint adds to it
        const double spread = std::pow(footprint / height, 2) / 12;
        EXPECT_LT(sample_variance(aimed).mean, (1e-7 + 1.1 * spread) * mean * mean);
        EXPECT_NEAR(shared_mean(aimed).mean / mean, 1, 4 * sigma);
    }
}

TEST(MediaDistance, HasTheMeanOfAirlight) {
    const struct {
        Airlight airlight;
        Distances distances;
    } cases[] = {
        {near_thin, Distances::mis},
        {near_dense, Distances::equiangular},
        {nearest, Distances::equiangular}};
    for (const auto& [airlight, distances] : cases) {
        const Strictness strictness{.tests = std::size(cases), .truth_error = 3e-5};
        RenderSettings settings = airlight.settings(distances, 32, 64);
        settings.sobol = true;
        EXPECT_TRUE(has_mean(
            shared_mean(render_for(strictness, airlight.scene(), settings)), airlight.radiance(),
            strictness))
            << airlight.height << ", " << name_of(distances);
    }
}

struct Way {
    const char* method;
    Distances distances;
    bool phase = true;
    Splits splits = {};
    uint32_t depth = 1;
};

// A ball of radius 1 whose wall has albedo rho and emits 1, filled with a medium, seen from its
// centre: by its integral equation.
struct Cavity {
    double sigma, albedo, rho, truth;

    static constexpr int subdivisions = 4;

    Scene scene() const {
        Scene s = scene_named("cavity");
        const Material wall = lambert(grey(static_cast<float>(rho)), grey(1));
        add_icosphere(s, wall, {0, 0, 0}, 1, subdivisions, Facing::inward);
        add_box(
            s, boundary_of(medium_of(sigma, albedo)), {-1.2, -1.2, -1.2}, {1.2, 1.2, 1.2},
            Facing::outward);
        return s;
    }

    static Camera camera() { return perspective({0, 0, 0}, {1, 0.3, 0.2}, 1); }
};

constexpr Cavity thin_cavity{0.5, 0.5, 0.5, 1.195216705};

void expect_mean_in_a_cavity(const std::vector<Way>& ways, double bias) {
    const Scene scene = thin_cavity.scene();
    for (const Way& way : ways) {
        SCOPED_TRACE(fmt::format(
            "{}, {}, splits {},{},{} to {}", way.method, name_of(way.distances), way.splits.stops,
            way.splits.directions, way.splits.reflections, way.depth));
        RenderSettings settings = square_settings(way.method, Cavity::camera(), 16, 64);
        settings.method.distances = way.distances;
        settings.method.phase_directions = way.phase;
        settings.splits = way.splits;
        settings.split_depth = way.depth;
        const Strictness strictness{
            .bias = bias,
            .tests = ways.size(),
            .truth_error = icosphere_sagitta(Cavity::subdivisions)};
        EXPECT_TRUE(has_mean(
            shared_mean(render_for(strictness, scene, settings)), thin_cavity.truth, strictness));
    }
}

// Where fog touches walls that emit, light points alone have no finite variance
// (SlopesWhereTheLightIsInTheFog below), nor have equiangular stops alone. The second is the notes'
// own estimator of section 6, split as they do.
TEST(MediaDistance, ChangesNoMeanInACavity) {
    expect_mean_in_a_cavity(
        {{"mis", Distances::mis, true, {}, 0},
         {"path", Distances::uniform, false, {2, 2, 2}, 2},
         {"bsdf", Distances::mis, true, {3, 2, 1}},
         {"mis", Distances::exponential, true, {1, 3, 1}}},
        0.01);
}

TEST(MediaDistance, ChangesNoMeanInACavityInOtherWays_long) {
    WAVEPATH_SKIP_UNLESS_LONG();
    expect_mean_in_a_cavity(
        {{"path", Distances::exponential},
         {"path", Distances::uniform, false, {}, 0},
         {"bsdf", Distances::truncated, true, {}, 3},
         {"mis", Distances::truncated, true, {4, 1, 1}},
         {"mis", Distances::mis, true, {}, 0},
         {"mis", Distances::mis, false, {1, 1, 1}, 2},
         {"bsdf", Distances::uniform, true, {2, 2, 1}, 2}},
        0.005);
}

TEST(MediaDistance, OtherCavitiesHaveTheirMeans) {
    constexpr Cavity cavities[] = {
        {0.5, 0, 0.5, .824360635}, {1, 0.9, 0.8, 2.939567681}, {2, 0.9, 0.8, 1.911639852}};
    for (const Cavity& cavity : cavities) {
        const Strictness strictness{
            .tests = std::size(cavities),
            // walls that reflect more add up what the mesh errs
            .truth_error = 5 * icosphere_sagitta(Cavity::subdivisions)};
        const RenderSettings settings = square_settings("mis", Cavity::camera(), 16, 256);
        EXPECT_TRUE(has_mean(
            shared_mean(render_for(strictness, cavity.scene(), settings)), cavity.truth,
            strictness))
            << cavity.sigma;
    }
}

// A lamp in the fog that the camera looks at: stops come as near to it as they like, and a light
// point at distance d counts as 1 / d^2, tail index 3/2, so that the error of light points alone
// falls as N^(-1/3); `mis` is back at N^(-1/2).
TEST(MediaDistance, SlopesWhereTheLightIsInTheFog) {
    Scene scene = scene_named("lamp in fog");
    add_box(scene, boundary_of(medium_of(1, 1)), {-1, -1, -1}, {1, 1, 1}, Facing::outward);
    add_square(scene, lambert(grey(0), grey(1)), {0, 0, 0}, {0, 0, 1}, 1);
    const auto slope = [&](const char* method) {
        RenderSettings settings =
            square_settings(method, orthographic({0.1, 0.03, 2}, {0.1, 0.03, 0}, 1e-2), 8, 1);
        settings.method.distances = Distances::truncated;
        settings.termination = {TerminationKind::depth, 1, 1};
        return error_slope(scene, settings, 64, 4096);
    };
    EXPECT_NEAR(slope("direct"), -1.0 / 3, 0.1);
    EXPECT_NEAR(slope("direct-bsdf"), -1.0 / 3, 0.1);
    EXPECT_NEAR(slope("mis"), -0.5, 0.1);
}

// Weights and roulette of children leave no other trace either: coloured media, boundaries in the
// way, a lamp in the fog. Each against exponential distances.
void expect_agreement_in_a_room(
    const std::vector<Distances>& others, uint64_t samples, double bias) {
    Scene scene = scene_named("foggy room");
    add_box(scene, lambert({0.7F, 0.5F, 0.4F}), {-1, -1, -1}, {1, 1, 1}, Facing::inward);
    add_square(scene, lambert(grey(0), grey(6)), {0, 0.9, 0}, {0, -1, 0}, 0.8);
    Medium fog = medium_of(0.8, 0.9, 0.5);
    fog.sigma_a = {0.3F, 0.1F, 0};
    add_box(scene, boundary_of(fog), {-1.1, -1.1, -1.1}, {1.1, 1.1, 1.1}, Facing::outward);
    add_icosphere(scene, boundary_of(medium_of(4, 0.9, -0.3)), {-0.3, -0.3, 0}, 0.4, 2);
    RenderSettings settings =
        square_settings("mis", perspective({0.8, 0.2, 0.9}, {-0.2, -0.4, -0.3}, 1.2), 32, samples);
    settings.split_depth = 2;
    const RenderResult first = render_scene(scene, settings);
    for (const Distances distances : others) {
        settings.method.distances = distances;
        ++settings.seed;
        const RenderResult result = render_scene(scene, settings);
        for (const char* channel : {"R", "B"})
            EXPECT_TRUE(agree(
                image_mean(first, channel), image_mean(result, channel),
                {.bias = bias, .tests = 2 * others.size()}))
                << name_of(distances) << ", " << channel;
    }
}

TEST(MediaDistance, ChangesNoMeanInARoom) {
    expect_agreement_in_a_room({Distances::mis}, 320, 0.03);
}

// but for equiangular ones alone, whose variance grows with the logarithm of N where a ray meets
// the lamp within the fog: a light point at distance D of the ray leaves stops far from it 1 / D
TEST(MediaDistance, ChangesNoMeanInARoomInOtherWays_long) {
    WAVEPATH_SKIP_UNLESS_LONG();
    expect_agreement_in_a_room(
        {Distances::uniform, Distances::truncated, Distances::mis}, 8192, 0.01);
}

}  // namespace
}  // namespace wavepath
