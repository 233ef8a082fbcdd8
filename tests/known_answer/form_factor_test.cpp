// S6: a white face under a black one of radiance 1. The image is the whole face, so that its mean
// is the form factor and the singular corner is in it. S5 and S2: spheres of triangles.
#include "support/rendering.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace wavepath {
namespace {

constexpr double pi = std::numbers::pi;

const Material lamp = lambert(grey(0), grey(1));
const Material white = lambert(grey(1));

struct Faces {
    const char* name;
    Vec3d u, v;                     // the receiver: u x v spans it from the origin, facing +z
    Vec3d light, light_u, light_v;  // the light, facing the receiver
    double factor;
};

TEST(FormFactor, OfRectangles) {
    const Faces cases[] = {
        {"parallel, 1 apart",
         {1, 0, 0},
         {0, 1, 0},
         {0, 0, 1},
         {0, 1, 0},
         {1, 0, 0},
         .1998248956983874},
        {"parallel, .1 apart",
         {1, 0, 0},
         {0, 1, 0},
         {0, 0, .1},
         {0, 1, 0},
         {1, 0, 0},
         .8269945223972566},
        {"parallel, 2 x 1",
         {2, 0, 0},
         {0, 1, 0},
         {0, 0, 1},
         {0, 1, 0},
         {2, 0, 0},
         .2858753848507147},
        {"perpendicular", {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {0, 1, 0}, {0, 0, 1}, .2000437760754032},
        {"perpendicular, light 2 high",
         {1, 0, 0},
         {0, 1, 0},
         {0, 0, 0},
         {0, 1, 0},
         {0, 0, 2},
         .2328526027953619},
        {"perpendicular, face half as wide",
         {.5, 0, 0},
         {0, 1, 0},
         {0, 0, 0},
         {0, 1, 0},
         {0, 0, 1},
         .2923733582114266},
    };
    for (const Faces& f : cases) {
        SCOPED_TRACE(f.name);
        Scene scene = scene_named(f.name);
        add_quad(scene, white, {0, 0, 0}, f.u, f.v);
        add_quad(scene, lamp, f.light, f.light_u, f.light_v);
        const Vec3d centre{f.u[0] / 2, f.v[1] / 2, 0};
        Camera camera = orthographic({centre[0], centre[1], 0.01}, centre, f.v[1]);
        RenderSettings settings = square_settings("mis", camera, 32, 192);
        settings.width = static_cast<uint32_t>(32 * f.u[0]);
        EXPECT_TRUE(has_mean(image_mean(render_for({}, scene, settings)), f.factor));
    }
}

// E = pi (r / d)^2 cos where the whole cone is above the horizon. 81920 triangles lie within 5.2e-5
// r of the sphere, and their silhouette, squared in E, within twice that.
TEST(FormFactor, OfASphereLight) {
    const struct {
        double distance, degrees, irradiance;
    } rows[] = {
        {2, 0, .78539816339745},
        {2, 60, .39269908169872},
        {2, 80, .17183197512740},
        {1.01, 60, 2.09812274020643}};
    constexpr int subdivisions = 6;
    for (const auto& [distance, degrees, irradiance] : rows) {
        for (const char* method : {"mis", "bsdf"}) {
            SCOPED_TRACE(fmt::format("{}: distance {}, {} degrees", method, distance, degrees));
            Scene scene = scene_named("sphere light");
            add_icosphere(scene, lamp, {0, 0, distance}, 1, subdivisions);
            const Vec3d normal{std::sin(degrees * pi / 180), 0, std::cos(degrees * pi / 180)};
            const double gap = distance - 1;
            add_square(scene, white, {0, 0, 0}, normal, 0.02 * gap);
            const Camera camera = close_up({0, 0, 0}, normal, 0.1 * gap, 2e-3 * gap);
            const double truth_error =
                4 * icosphere_sagitta(subdivisions) / std::min(1.0, gap / 0.1);
            // by chance few directions find a sphere most of which is below the horizon
            const double bias = method == std::string("bsdf") && degrees == 80 ? 0.01 : 0.005;
            const Strictness strictness{.bias = bias, .truth_error = truth_error};
            const RenderResult result =
                render_for(strictness, scene, square_settings(method, camera, 16, 512));
            EXPECT_TRUE(has_mean(shared_mean(result), irradiance / pi, strictness));
        }
    }
}

// Inside a sphere every point sees every other alike: two halves with reflectances .2 and .8, of
// which the first emits 1, settle at H = (f1 E1 + f2 E2) / (1 - f1 r1 - f2 r2) = 1, so at 1.2 and
// .8.
TEST(SphereEnclosure, OfTwoHalves) {
    Scene scene = scene_named("two halves");
    Primitive sphere =
        add_icosphere(scene, lambert(grey(0.2F), grey(1)), {0, 0, 0}, 1, 5, Facing::inward);
    std::vector<uint32_t> halves[2];
    for (std::size_t t = 0; t < sphere.indices.size(); t += 3) {
        double height = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            // An oblique plane: no triangle of the centrally symmetric icosphere has its centroid
            // on it.
            const float* p = &sphere.positions[std::size_t{3} * sphere.indices[t + k]];
            height += 0.123 * p[0] + 0.057 * p[1] + p[2];
        }
        auto& half = halves[height > 0 ? 0 : 1];
        half.insert(half.end(), {sphere.indices[t], sphere.indices[t + 1], sphere.indices[t + 2]});
    }
    ASSERT_EQ(halves[0].size(), halves[1].size());
    scene.primitives[0].indices = halves[0];
    add_triangles(scene, lambert(grey(0.8F)), sphere.positions, halves[1]);
    for (const char* method : {"mis", "bsdf"}) {
        for (const auto& [z, truth] : {std::pair{0.9, 1.2}, {-0.9, 0.8}}) {
            SCOPED_TRACE(fmt::format("{}, half at z = {}", method, z));
            const Camera camera = perspective({0, 0, 0}, {0.3, 0.1, z}, 0.4);
            const Strictness strictness{.truth_error = 2 * icosphere_sagitta(5)};
            const RenderResult result =
                render_for(strictness, scene, square_settings(method, camera, 32, 128));
            EXPECT_TRUE(has_mean(shared_mean(result), truth, strictness));
        }
    }
}

// A point source at the centre: after all reflections rho / (1 - rho) I / pi, after the first rho I
// / pi.
TEST(SphereEnclosure, OfAPointSource) {
    Scene scene = scene_named("point source");
    add_icosphere(scene, lambert({0.5F, 0.9F, 0}), {0, 0, 0}, 1, 5, Facing::inward);
    scene.lights.push_back({});
    const Camera camera = perspective({0, 0, 0.3}, {0.3, 0.1, -0.9}, 0.8);
    RenderSettings settings = square_settings("direct", camera, 32, 128);
    const Strictness strictness{.truth_error = 4 * icosphere_sagitta(5)};
    const RenderResult all = render_for(strictness, scene, settings, "G");
    EXPECT_TRUE(has_mean(shared_mean(all, "R"), .318309886184, strictness));
    EXPECT_TRUE(has_mean(shared_mean(all, "G"), 2.864788975654, strictness));
    settings.termination = {TerminationKind::depth, 1, 1};
    settings.samples = 16;
    const RenderResult first = render_scene(scene, settings);
    EXPECT_TRUE(has_mean(shared_mean(first, "R"), .159154943092, strictness));
    EXPECT_TRUE(has_mean(shared_mean(first, "G"), .286478897565, strictness));
    settings.termination = {TerminationKind::depth, 2, 1};
    const RenderResult second = render_scene(scene, settings);
    EXPECT_TRUE(has_mean(shared_mean(second, "R"), .238732414638, strictness));
    EXPECT_TRUE(has_mean(shared_mean(second, "G"), .544309905374, strictness));
}

}  // namespace
}  // namespace wavepath
