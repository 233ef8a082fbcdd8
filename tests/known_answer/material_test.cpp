// S8, S9: directional albedos of the glTF materials, as a flat plate in a uniform environment of
// radiance 1. The tables are right to 3e-6; base colours 1 and .5 are two channels of one picture.
#include "support/rendering.h"

#include <cmath>

namespace wavepath {
namespace {

struct Row {
    float roughness;
    double mu;
    double dielectric_1, dielectric_half, metal_1, metal_half;
};

const Row rows[] = {
    {.1F, 1, .999917, .519957, .999898, .499949},   {.1F, .5, 1.025378, .547758, .999742, .515573},
    {.1F, .2, 1.297428, .824779, .998587, .661891}, {.3F, 1, .999553, .519593, .990665, .495335},
    {.3F, .5, 1.025359, .547739, .975089, .503750}, {.3F, .2, 1.198276, .725627, .914026, .569731},
    {.5F, 1, .996580, .516620, .915814, .457921},   {.5F, .5, 1.010985, .533365, .857263, .439805},
    {.5F, .2, 1.073558, .600909, .848160, .473212}, {.7F, 1, .987876, .507916, .697750, .348898},
    {.7F, .5, .993436, .515816, .703974, .357214},  {.7F, .2, 1.017525, .544877, .792716, .417462},
    {1, 1, .972228, .492267, .306853, .153444},     {1, .5, .976138, .498518, .450694, .226841},
    {1, .2, .984430, .511781, .641648, .327838},
};

const Rgb white_and_half{1, 0.5F, 0.25F};

// By the letter of glTF, which the table follows, unless layers conserve.
RenderResult plate_in_furnace(
    const Material& material, double mu, const char* method, bool layers_conserve = false) {
    Scene scene = scene_named("plate");
    add_square(scene, material, {0, 0, 0}, {0, 0, 1}, 1);
    scene.environment = constant_environment(1);
    const Camera camera = orthographic({std::sqrt(1 - mu * mu), 0, mu}, {0, 0, 0}, 0.01);
    RenderSettings settings = square_settings(method, camera, 16, 256);
    settings.layers_conserve = layers_conserve;
    return render_for({}, scene, settings, "G");
}

void expect_table(const char* method, float least_roughness) {
    constexpr Strictness strictness{.truth_error = 1e-5};
    for (const Row& row : rows) {
        if (row.roughness < least_roughness) continue;
        SCOPED_TRACE(fmt::format("{}, roughness {}, mu {}", method, row.roughness, row.mu));
        const RenderResult layered =
            plate_in_furnace(dielectric(white_and_half, row.roughness), row.mu, method);
        EXPECT_TRUE(has_mean(shared_mean(layered, "R"), row.dielectric_1, strictness));
        EXPECT_TRUE(has_mean(shared_mean(layered, "G"), row.dielectric_half, strictness));
        const RenderResult metallic =
            plate_in_furnace(metal(white_and_half, row.roughness), row.mu, method);
        EXPECT_TRUE(has_mean(shared_mean(metallic, "R"), row.metal_1, strictness));
        EXPECT_TRUE(has_mean(shared_mean(metallic, "G"), row.metal_half, strictness));
    }
}

TEST(MaterialInFurnace, SampledByItsLobes) {
    expect_table("bsdf", 0);
}

// Right to the 4e-4 of the table of albedos; base 1 reflects all, half leaves half of what enters.
TEST(MaterialInFurnace, ReflectsAllThatEntersWhereLayersConserve) {
    constexpr Strictness strictness{.truth_error = 4e-4};
    for (const Row& row : rows) {
        SCOPED_TRACE(fmt::format("roughness {}, mu {}", row.roughness, row.mu));
        const RenderResult result =
            plate_in_furnace(dielectric(white_and_half, row.roughness), row.mu, "bsdf", true);
        const double specular = 2 * row.dielectric_half - row.dielectric_1;
        EXPECT_TRUE(has_mean(shared_mean(result, "R"), 1, strictness));
        EXPECT_TRUE(has_mean(shared_mean(result, "G"), (1 + specular) / 2, strictness));
    }
}

TEST(MaterialInFurnace, SampledByCosine) {
    expect_table("path", 0.7F);
}

TEST(MaterialInFurnace, SampledAsALight) {
    for (const Row& row : rows) {
        if (row.roughness < 1) continue;
        SCOPED_TRACE(fmt::format("mu {}", row.mu));
        const RenderResult layered =
            plate_in_furnace(dielectric(white_and_half, row.roughness), row.mu, "direct");
        EXPECT_TRUE(has_mean(shared_mean(layered, "R"), row.dielectric_1, {.truth_error = 1e-5}));
    }
}

TEST(MaterialInFurnace, LobesAndCosineAgreeWhereTheTableHasNothing) {
    Material half = metal({0.9F, 0.6F, 0.3F}, 0.8F);
    half.metallic = 0.5F;
    half.specular = 0.7F;
    half.ior = 2;
    for (const bool layers_conserve : {false, true}) {
        const RenderResult lobes = plate_in_furnace(half, 0.6, "bsdf", layers_conserve);
        const RenderResult cosine = plate_in_furnace(half, 0.6, "path", layers_conserve);
        for (const char* channel : {"R", "G", "B"}) {
            SCOPED_TRACE(channel);
            EXPECT_TRUE(
                agree(shared_mean(lobes, channel), shared_mean(cosine, channel), {.bias = 0.01}));
        }
    }
}

// Metallic 1, roughness 0, base colour 1 reflects all: nothing in a furnace may change.
TEST(MirrorInFurnace, ChangesNothing) {
    for (const char* method : {"path", "bsdf", "mis"}) {
        SCOPED_TRACE(method);
        Scene scene = scene_named("mirror in furnace");
        add_box(scene, lambert(grey(0.5F), grey(0.5F)), {-1, -1, -1}, {1, 1, 1}, Facing::inward);
        add_box(scene, metal(grey(1), 0), {-0.3, -0.3, -0.3}, {0.3, 0.2, 0.1}, Facing::outward);
        const Camera camera = perspective({0.7, 0.6, 0.8}, {0, 0, 0}, 0.6);
        const RenderResult result = render_scene(scene, square_settings(method, camera, 64, 320));
        EXPECT_TRUE(has_mean(shared_mean(result), 1));
        for (const Estimate& block : block_means(result))
            EXPECT_TRUE(has_mean(block, 1, {.bias = 0.1, .tests = 64}));
    }
}

// Walls of any reflectance that emit (1 - rho) B: radiance B everywhere, mirrors included.
TEST(IsothermalEnclosure, HasOneRadiance) {
    Scene scene = scene_named("isothermal enclosure");
    const auto wall = [&](float albedo, const Vec3d& corner, const Vec3d& u, const Vec3d& v) {
        add_quad(scene, lambert(grey(albedo), grey(1 - albedo)), corner, u, v);
    };
    wall(0.2F, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    wall(0.8F, {0, 0, 1}, {0, 1, 0}, {1, 0, 0});
    wall(0.5F, {0, 0, 0}, {0, 1, 0}, {0, 0, 1});
    wall(0.9F, {1, 0, 0}, {0, 0, 1}, {0, 1, 0});
    wall(0.0F, {0, 0, 0}, {0, 0, 1}, {1, 0, 0});
    add_quad(scene, metal(grey(1), 0), {0, 1, 0}, {1, 0, 0}, {0, 0, 1});
    add_box(
        scene, lambert(grey(0.6F), grey(0.4F)), {0.2, 0.1, 0.3}, {0.5, 0.4, 0.5}, Facing::outward);
    for (const char* method : {"bsdf", "mis"}) {
        SCOPED_TRACE(method);
        const Camera camera = perspective({0.8, 0.7, 0.9}, {0.3, 0.4, 0.2}, 1.3);
        const RenderResult result = render_scene(scene, square_settings(method, camera, 64, 320));
        EXPECT_TRUE(has_mean(image_mean(result), 1));
        for (const Estimate& block : block_means(result))
            EXPECT_TRUE(has_mean(block, 1, {.bias = 0.1, .tests = 64}));
    }
}

}  // namespace
}  // namespace wavepath
