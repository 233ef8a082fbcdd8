// S3: radiance E / pi of a white Lambert patch under a black polygon of radiance 1; truths by
// Lambert's formula in 40 digits. Variances of one sample as predicted for cosine sampling, area
// sampling and the power heuristic.
#include "support/rendering.h"

#include <numbers>

namespace wavepath {
namespace {

constexpr double pi = std::numbers::pi;

const Material lamp = lambert(grey(0), grey(1));
const Material white = lambert(grey(1));

struct Receiver {
    Vec3d p, normal;
    double irradiance;    // of a light of radiance 1
    double distance = 1;  // the smallest length nearby: patch and footprint stay far below it
};

// One patch under `light`, and the camera that sees a hundredth of its least distance.
struct PatchView {
    Scene scene;
    Camera camera;

    PatchView(Scene lights, const Receiver& r)
        : scene(std::move(lights)),
          camera(close_up(r.p, r.normal, 0.2 * r.distance, 2e-3 * r.distance)) {
        add_square(scene, white, r.p, r.normal, 0.02 * r.distance);
    }
};

Scene square_light() {
    Scene scene = scene_named("square light");
    add_square(scene, lamp, {0, 0, 1}, {0, 0, -1}, 1);
    return scene;
}

// Of the light [0,1] x [-.5,.5] at z = 1, which touches the wall x = 0 that the receivers lie in.
Scene light_at_wall() {
    Scene scene = scene_named("light at wall");
    add_square(scene, lamp, {0.5, 0, 1}, {0, 0, -1}, 1);
    return scene;
}

Scene triangle_light() {
    Scene scene = scene_named("triangle light");
    add_triangles(scene, lamp, {0, 0, 1, 1, 0, 1, 0, 1, 1}, {0, 2, 1});
    return scene;
}

const Receiver floor_points[] = {
    {{0, 0, 0}, {0, 0, 1}, 0.7522746884541075},
    {{0.5, 0, 0}, {0, 0, 1}, 0.5666451120495073},
    {{0.5, 0.5, 0}, {0, 0, 1}, 0.4352098756835516},
    {{1, 0.5, 0}, {0, 0, 1}, 0.2154559703138851},
};
const Receiver far_points[] = {
    {{2, 1, 0}, {0, 0, 1}, 0.03023651582530077},
    {{10, 0, 0}, {0, 0, 1}, 9.866871875955458e-5},
};
const Receiver tilted_points[] = {
    {{0, 0, 0}, {1, 0, 1}, 0.5319385335208968},
    {{0, 0, 0}, {1, 0, 0}, 0.08751026477375238},
    {{0.2, 0.1, 0.3}, {0, 1, 1}, 0.732156927081709},
    {{-0.6, 0, 0.9}, {1, 0, 0}, 0.8773269681301587, 0.1},
    {{0.3, 0, 0.5}, {1, 0, 0.1}, 0.1435697607228396},
};
const Receiver triangle_points[] = {
    {{0, 0, 0}, {0, 0, 1}, 0.3022998940390363},
    {{1.0 / 3, 1.0 / 3, 0}, {0, 0, 1}, 0.4134782845659833},
    {{1, 1, 0}, {0, 0, 1}, 0.1329099816445153},
};

// `bias` above 0.005: for variances of so long a tail that the pilot render may miss it.
void expect_irradiance(
    const Scene& lights, const Receiver& receiver, const char* method, double bias = 0.005) {
    SCOPED_TRACE(fmt::format(
        "{}, {} at ({}, {}, {}), normal ({}, {}, {})", lights.name, method, receiver.p[0],
        receiver.p[1], receiver.p[2], receiver.normal[0], receiver.normal[1], receiver.normal[2]));
    const PatchView view(lights, receiver);
    // few pixels of many samples: Sobol points gain more than pixels do
    const RenderResult result =
        render_for({}, view.scene, square_settings(method, view.camera, 16, 256));
    // truth_error: the second order of the footprint
    EXPECT_TRUE(has_mean(
        shared_mean(result), receiver.irradiance / pi, {.bias = bias, .truth_error = 1e-5}));
}

TEST(Irradiance, OfASquareLightByLightSampling) {
    for (const char* method : {"direct", "direct-bsdf", "mis"}) {
        for (const Receiver& r : floor_points) expect_irradiance(square_light(), r, method);
        for (const Receiver& r : far_points) expect_irradiance(square_light(), r, method);
    }
}

TEST(Irradiance, OfASquareLightByChance) {
    for (const char* method : {"path", "bsdf"}) {
        expect_irradiance(square_light(), floor_points[0], method);
        expect_irradiance(square_light(), floor_points[2], method);
    }
}

TEST(Irradiance, OfTiltedAndHalfLitReceivers) {
    for (const Receiver& r : tilted_points) expect_irradiance(square_light(), r, "mis");
    expect_irradiance(square_light(), tilted_points[1], "direct");
}

TEST(Irradiance, OfATriangleLight) {
    for (const char* method : {"direct", "mis"})
        for (const Receiver& r : triangle_points) expect_irradiance(triangle_light(), r, method);
}

// Receivers close to the light: area sampling has a relative variance of A / (3 pi d^2), the power
// heuristic stays calm.
TEST(Irradiance, InTheGapUnderTheLight) {
    const struct {
        double gap, centre, edge, corner;
    } rows[] = {
        {0.1, 0.96833955697404, 0.48933177056384, 0.24797140829531},
        {1e-2, 0.99967278693645, 0.49989033763249, 0.24997954398597},
        {1e-3, 0.99999672677155, 0.49999890306865, 0.24999979542270},
    };
    for (const auto& [gap, centre, edge, corner] : rows) {
        expect_irradiance(square_light(), {{0, 0, 1 - gap}, {0, 0, 1}, pi * centre, gap}, "mis");
        expect_irradiance(
            square_light(), {{0.5, 0, 1 - gap}, {0, 0, 1}, pi * edge, 0.1 * gap}, "mis", 0.01);
        expect_irradiance(
            square_light(), {{0.5, 0.5, 1 - gap}, {0, 0, 1}, pi * corner, 0.1 * gap}, "mis", 0.01);
    }
}

TEST(Irradiance, OfAWallThatTouchesTheLight) {
    for (const auto& [gap, factor] :
         {std::pair{0.1, 0.42254486023906}, {1e-2, 0.49215895216345}, {1e-3, 0.49921579759626}})
        expect_irradiance(light_at_wall(), {{0, 0, 1 - gap}, {1, 0, 0}, pi * factor, gap}, "mis");
}

TEST(Irradiance, HasThePredictedVariance) {
    const struct {
        Scene lights;
        Receiver receiver;
        double path, direct, mis;  // relative variance of one sample
    } rows[] = {
        {square_light(), floor_points[0], 3.17612, 0.0303545, 0.0336761},
        {square_light(), floor_points[2], 6.21857, 0.255292, 0.224867},
        {square_light(),
         {{0, 0, 0.9}, {0, 0, 1}, pi * 0.96833955697404, 0.1},
         0.0326956,
         10.3151,
         0.139377},
        {light_at_wall(),
         {{0, 0, 0.9}, {1, 0, 0}, pi * 0.42254486023906, 0.1},
         1.36661,
         6.42329,
         0.982301},
    };
    for (const auto& row : rows) {
        const PatchView view(row.lights, row.receiver);
        for (const auto& [method, predicted] :
             {std::pair{"path", row.path}, {"direct", row.direct}, {"mis", row.mis}}) {
            SCOPED_TRACE(fmt::format("{}, {}", row.lights.name, method));
            RenderSettings settings = square_settings(method, view.camera, 1024, 1);
            settings.sobol = false;
            // Both triangles alike, as predicted: by power the nearer one is preferred, as the view
            // is small beside the scene.
            settings.method.light_choice = LightChoice::area;
            const double mean = row.receiver.irradiance / pi;
            EXPECT_TRUE(has_mean(
                sample_variance(render_scene(view.scene, settings)), predicted * mean * mean,
                {.bias = 0.125, .truth_error = 1e-4}));
        }
    }
}

// A wall that a long light touches: the samples of `direct` have tail index 3/2, so its error falls
// as N^(-1/3), and the z-test does not apply; `mis` is back at N^(-1/2). Each of the 16 pixels
// along the wall reaches up to the light.
TEST(Irradiance, SlopesWhereTheLightTouchesTheWall) {
    Scene scene = scene_named("long wall");
    add_quad(scene, white, {0, -10, 0}, {0, 20, 0}, {0, 0, 1});
    add_quad(scene, lamp, {0, -10, 1}, {0, 20, 0}, {1, 0, 0});
    const Camera camera = orthographic({0.1, 0, 0.5}, {0, 0, 0.5}, 1);
    const auto slope = [&](const char* method) {
        RenderSettings settings = square_settings(method, camera, 1, 1);
        // the camera's up axis is y: the wall runs along the columns
        settings.height = 16;
        settings.camera.y_mag = 8;
        return error_slope(scene, settings, 128, 8192);
    };
    EXPECT_NEAR(slope("direct"), -1.0 / 3, 0.1);
    EXPECT_NEAR(slope("mis"), -0.5, 0.1);
}

// Relative variances of 314 and 1061: 6.6e8 and 2.2e9 independent samples, of Sobol's points fewer.
// Ten times farther or nearer, 6.6e10 and 2.2e11 would do.
void expect_irradiance_by_force(const Receiver& receiver, const char* method, uint64_t samples) {
    const PatchView view(square_light(), receiver);
    EXPECT_TRUE(has_mean(
        shared_mean(render_scene(view.scene, square_settings(method, view.camera, 256, samples))),
        receiver.irradiance / pi, {.truth_error = 1e-5}));
}

TEST(Irradiance, OfAFarLightByChance_long) {
    WAVEPATH_SKIP_UNLESS_LONG();
    expect_irradiance_by_force({{0, 0, -9}, {0, 0, 1}, pi * 0.0031725255}, "path", 12000);
}

TEST(Irradiance, InAGapOfAHundredthByLightSampling_long) {
    WAVEPATH_SKIP_UNLESS_LONG();
    expect_irradiance_by_force(
        {{0, 0, 0.99}, {0, 0, 1}, pi * 0.99967278693645, 1e-2}, "direct", 20000);
}

}  // namespace
}  // namespace wavepath
