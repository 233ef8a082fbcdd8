// What a triangle is: fronts and backs of lights, vertex colours and normals, mirrored instances.
#include "support/rendering.h"

namespace wavepath {
namespace {

// A white floor under a square light at z = 1; F = .2394564704607735 at the origin.
constexpr double below_centre = .2394564704607735;

Scene floor_and_light(const Vec3d& light_normal, bool double_sided) {
    Scene scene = scene_named("floor and light");
    add_square(scene, lambert(grey(1)), {0, 0, 0}, {0, 0, 1}, 0.1);
    add_square(scene, lambert(grey(0), grey(1), double_sided), {0, 0, 1}, light_normal, 1);
    return scene;
}

const Camera at_origin = close_up({0, 0, 0}, {0, 0, 1}, 0.1, 2e-3);

TEST(AreaLight, EmitsFromItsFrontOnly) {
    for (const char* method : {"bsdf", "direct", "mis"}) {
        SCOPED_TRACE(method);
        const RenderResult back = render_scene(
            floor_and_light({0, 0, 1}, false), square_settings(method, at_origin, 64, 16));
        EXPECT_EQ(shared_mean(back).mean, 0);
    }
}

TEST(AreaLight, EmitsBothWaysWhenDoubleSided) {
    for (const Vec3d& normal : {Vec3d{0, 0, 1}, Vec3d{0, 0, -1}}) {
        for (const char* method : {"bsdf", "direct", "mis"}) {
            SCOPED_TRACE(method);
            const RenderResult result = render_for(
                {}, floor_and_light(normal, true), square_settings(method, at_origin, 16, 256));
            EXPECT_TRUE(has_mean(shared_mean(result), below_centre, {.truth_error = 1e-5}));
        }
    }
}

// A mirroring node turns the winding; the light stays a light to the floor below it.
TEST(AreaLight, KeepsItsFrontUnderAMirroringNode) {
    for (const Matrix4& mirror :
         {Matrix4{-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1},
          Matrix4{1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}) {
        Scene scene = floor_and_light({0, 0, -1}, false);
        scene.instances[1].to_world = mirror;
        const RenderResult result =
            render_for({}, scene, square_settings("mis", at_origin, 16, 256));
        EXPECT_TRUE(has_mean(shared_mean(result), below_centre, {.truth_error = 1e-5}));
    }
}

TEST(AreaLight, FacesTheOtherWayWhenMirroredAlongItsNormal) {
    Scene scene = floor_and_light({0, 0, -1}, false);
    scene.instances[1].to_world = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 2, 1};
    const RenderResult result = render_scene(scene, square_settings("mis", at_origin, 64, 16));
    EXPECT_EQ(shared_mean(result).mean, 0);
}

TEST(VertexColours, MultiplyTheBaseColour) {
    Scene scene = scene_named("coloured plate");
    Primitive& plate = add_quad(scene, lambert({0.8F, 0.5F, 1}), {-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
    // linear from 0 at y = -1 to 1 at y = 1 in the last channel: .5 in the middle
    plate.colors = {0.5F, 1, 0, 0.5F, 1, 0, 0.5F, 1, 1, 0.5F, 1, 1};
    scene.environment = constant_environment(1);
    const Camera camera = close_up({0.2, 0, 0}, {0, 0, 1}, 0.1, 1e-3);
    const RenderResult result = render_scene(scene, square_settings("bsdf", camera, 64, 768));
    EXPECT_TRUE(has_mean(shared_mean(result, "R"), 0.4));
    EXPECT_TRUE(has_mean(shared_mean(result, "G"), 0.5));
    EXPECT_TRUE(has_mean(shared_mean(result, "B"), 0.5));
    EXPECT_NEAR(result.film.image.channels.at("albedo.R")[0], 0.4, 1e-6);
}

// Smooth normals on a convex body in a uniform environment: rho, less what the faces hide from the
// tilted hemisphere, a quarter of the tilt squared.
TEST(VertexNormals, KeepTheEnergyOfASmoothSphere) {
    constexpr int subdivisions = 4;
    Scene scene = scene_named("smooth sphere");
    Primitive& sphere = add_icosphere(scene, lambert(grey(0.5F)), {0, 0, 0}, 1, subdivisions);
    sphere.normals = sphere.positions;
    scene.environment = constant_environment(1);
    RenderSettings settings =
        square_settings("bsdf", orthographic({0, 0, 3}, {0, 0, 0}, 1), 64, 64);
    settings.termination = {TerminationKind::zero, 0, 1};
    const RenderResult result = render_scene(scene, settings);
    const double tilt2 = 2 * icosphere_sagitta(subdivisions);
    EXPECT_TRUE(has_mean(shared_mean(result), 0.5, {.truth_error = tilt2 / 4}));
    // the normals vary smoothly: at the middle of the picture the sphere's own
    const std::vector<float>& z = result.film.image.channels.at("normal.Z");
    EXPECT_NEAR(z[32 * 64 + 32], 1, 1e-3);
}

}  // namespace
}  // namespace wavepath
