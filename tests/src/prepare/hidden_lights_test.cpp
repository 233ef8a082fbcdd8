#include "prepare/hidden_lights.h"

#include "support/media.h"

#include <gmock/gmock.h>

namespace wavepath {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

std::string warning(const Scene& scene) {
    return warning_of_hidden_lights(scene, normalise(scene));
}

// A block of glass of side 2 around the origin, a floor beside it, and a lamp.
Scene block(const Material& material, const PunctualLight& light) {
    Scene scene = scene_named("block");
    add_box(scene, material, {-1, -1, -1}, {1, 1, 1}, Facing::outward);
    add_square(scene, lambert(grey(0.5F)), {0, 0, -2}, {0, 0, 1}, 8);
    scene.materials[0].name = "Jar";
    scene.lights = {light};
    return scene;
}

PunctualLight light_of(LightKind kind) {
    PunctualLight light;
    light.kind = kind;
    light.name = "Key";
    light.position = {0, 0, 5};
    light.outer_cone = 0.3;
    return light;
}

TEST(HiddenLights, AreNamedOnceWhereTheyFallOnSmoothGlass) {
    EXPECT_THAT(
        warning(block(glass(1.5), light_of(LightKind::directional))),
        HasSubstr(
            "block: light of sun \"Key\" is missing behind bodies of smooth glass (\"Jar\")"));
    EXPECT_THAT(
        warning(block(glass(1.5), light_of(LightKind::point))), HasSubstr("point light \"Key\""));
    EXPECT_THAT(warning(block(glass(1.5), light_of(LightKind::spot))), HasSubstr("spot \"Key\""));
    Scene many = block(glass(1.5), light_of(LightKind::point));
    many.lights.back().name.clear();
    many.lights.resize(7, many.lights.back());
    EXPECT_THAT(
        warning(many),
        HasSubstr("point light 0, point light 1, point light 2, point light 3 and 3 more"));
}

TEST(HiddenLights, AreNotThoseThatFallOnNone) {
    PunctualLight light = light_of(LightKind::point);
    Material rough = glass(1.5);
    rough.roughness = 0.3F;
    Material wall = dielectric(grey(1), 0);
    wall.transmission = 1;
    for (const Material& material : {rough, wall, boundary_of({}), lambert(grey(0.5F))})
        EXPECT_THAT(warning(block(material, light)), IsEmpty());
    light.range = 2;
    EXPECT_THAT(warning(block(glass(1.5), light)), IsEmpty());
    light.range = 4.5;
    EXPECT_THAT(warning(block(glass(1.5), light)), Not(IsEmpty()));
    light = light_of(LightKind::spot);
    light.direction = {1, 0, 0};
    EXPECT_THAT(warning(block(glass(1.5), light)), IsEmpty());
    light = light_of(LightKind::point);
    light.intensity = grey(0);
    EXPECT_THAT(warning(block(glass(1.5), light)), IsEmpty());
    Scene dark = block(glass(1.5), light);
    dark.lights.clear();
    EXPECT_THAT(warning(dark), IsEmpty());
}

}  // namespace
}  // namespace wavepath
