// What is white reflects or lets through all light, so that a closed room whose only other surface
// is a black lamp of radiance 1 has the radiance 1 everywhere, whatever its walls are like.
#include "gltf/gltf_loader.h"
#include "support/rendering.h"
#include "support/sample_files.h"

#include <gmock/gmock.h>

#include <cmath>

namespace wavepath {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

// The table of albedos is right to 1e-4 on average, and light meets some ten walls before it ends
// at the lamp, which is one wall of six.
constexpr Strictness strictness{.bias = 0.01, .truth_error = 1e-3};

Scene room_of(const Material& walls) {
    Scene scene = scene_named("white room");
    add_quad(scene, lambert(grey(0), grey(1), true), {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    add_quad(scene, walls, {0, 0, 1}, {0, 1, 0}, {1, 0, 0});
    add_quad(scene, walls, {0, 0, 0}, {0, 1, 0}, {0, 0, 1});
    add_quad(scene, walls, {1, 0, 0}, {0, 0, 1}, {0, 1, 0});
    add_quad(scene, walls, {0, 0, 0}, {0, 0, 1}, {1, 0, 0});
    add_quad(scene, walls, {0, 1, 0}, {1, 0, 0}, {0, 0, 1});
    return scene;
}

void expect_radiance_1(const Scene& scene, const char* method) {
    const Camera camera = perspective({0.8, 0.7, 0.3}, {0.1, 0.2, 0.9}, 1.3);
    const RenderResult result =
        render_for(strictness, scene, square_settings(method, camera, 32, 64));
    EXPECT_TRUE(has_mean(shared_mean(result), 1, strictness));
}

TEST(WhiteRoom, OfDielectricsIsAsBrightAsItsLamp) {
    for (const float roughness : {0.0F, 0.04F, 0.2F, 0.5F, 1.0F})
        for (const float ior : {1.2F, 1.5F, 3.0F}) {
            SCOPED_TRACE(fmt::format("roughness {}, index {}", roughness, ior));
            Material walls = dielectric(grey(1), roughness);
            walls.ior = ior;
            expect_radiance_1(room_of(walls), "mis");
        }
}

TEST(WhiteRoom, OfAnySpecularWeightIsAsBrightAsItsLamp) {
    for (const char* method : {"bsdf", "mis"})
        for (const float specular : {0.0F, 0.3F}) {
            SCOPED_TRACE(fmt::format("{}, specular {}", method, specular));
            Material walls = dielectric(grey(1), 0.3F);
            walls.specular = specular;
            walls.specular_color = grey(2);
            expect_radiance_1(room_of(walls), method);
        }
}

// Index 0: everything is mirrored by facets, and what they lose is diffuse.
TEST(WhiteRoom, OfIndex0IsAsBrightAsItsLamp) {
    Material walls = dielectric(grey(1), 0.6F);
    walls.ior = 0;
    expect_radiance_1(room_of(walls), "mis");
}

// Walls of glass across the room, smooth and rough, let through what they do not reflect.
TEST(WhiteRoom, WithThinWallsIsAsBrightAsItsLamp) {
    for (const float roughness : {0.0F, 0.3F, 0.9F})
        for (const float transmission : {1.0F, 0.5F}) {
            SCOPED_TRACE(fmt::format("roughness {}, transmission {}", roughness, transmission));
            Scene scene = room_of(lambert(grey(1)));
            Material pane = dielectric(grey(1), roughness);
            pane.transmission = transmission;
            add_quad(scene, pane, {0, 0, 0.5}, {1, 0, 0}, {0, 1, 0});
            expect_radiance_1(scene, "mis");
        }
}

// A scene of a box of white plastic around a small lamp, in which the letter of glTF lets light
// grow without bound, and its twin of Lambert surfaces.
class WhitePlastic : public testing::Test {
  protected:
    void SetUp() override {
        folder_ = asset_folder().parent_path() / "cases" / "white-plastic";
        if (asset_folder().empty() || !std::filesystem::is_directory(folder_))
            GTEST_SKIP() << "no cases beside the sample models (support/sample_files.h)";
    }

    RenderResult render_case(const char* name, uint64_t samples, bool layers_conserve) const {
        const Scene scene = load_gltf(folder_ / name);
        RenderSettings settings = square_settings("mis", scene.cameras.at(0), 32, samples);
        settings.layers_conserve = layers_conserve;
        return render_scene(scene, settings);
    }

    std::filesystem::path folder_;
};

TEST_F(WhitePlastic, IsAsBrightAsItsDiffuseTwin) {
    for (const char* name : {"white_plastic_box.glb", "white_diffuse_box.glb"}) {
        SCOPED_TRACE(name);
        const RenderResult result = render_case(name, 96, true);
        EXPECT_TRUE(has_mean(image_mean(result), 1, {.bias = 0.05, .truth_error = 5e-3}));
        EXPECT_THAT(result.warnings, IsEmpty());
    }
}

// The albedo by the cosine of a plane in a white sky. By the letter of glTF it is above 1.
TEST_F(WhitePlastic, PlaneSendsBackAllLightAtEveryAngle) {
    Scene scene = load_gltf(folder_ / "white_plastic_plane.glb");
    scene.environment = constant_environment(1);
    for (const double cosine : {1., 0.7, 0.4, 0.2, 0.1, 0.05}) {
        SCOPED_TRACE(cosine);
        const Vec3d eye{std::sqrt(1 - cosine * cosine), cosine, 0};
        RenderSettings settings =
            square_settings("mis", orthographic(eye, {0, 0, 0}, 1e-3), 16, 256);
        EXPECT_TRUE(
            has_mean(shared_mean(render_for({}, scene, settings)), 1, {.truth_error = 1e-3}));
        if (cosine > 0.5) continue;
        settings.layers_conserve = false;
        EXPECT_GT(shared_mean(render_scene(scene, settings)).mean, 1.01);
    }
}

TEST_F(WhitePlastic, ByTheLetterIsWarnedOf) {
    const RenderResult result = render_case("white_plastic_box.glb", 16, false);
    EXPECT_GT(result.outlier.share, 0.15);
    EXPECT_THAT(
        result.warnings,
        testing::Contains(HasSubstr("of the picture's mean, which is not settled")));
    EXPECT_THAT(result.warnings, testing::Contains(HasSubstr("--layering specification")));
}

}  // namespace
}  // namespace wavepath
