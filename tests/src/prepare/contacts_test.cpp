#include "prepare/contacts.h"

#include "prepare/light_tables.h"
#include "support/media.h"

#include <gtest/gtest.h>

namespace wavepath {
namespace {

bool touched(const Scene& scene) {
    const NormalisedScene geometry = normalise(scene);
    return has_contacts(scene, geometry, build_bvh(geometry.positions));
}

Scene block_on(double floor, const Material& material = glass(1.5)) {
    Scene scene = scene_named("block");
    add_box(scene, material, {-1, -1, 0}, {1, 1, 1}, Facing::outward);
    add_square(scene, lambert(grey(0.5F)), {0, 0, floor}, {0, 0, 1}, 4);
    return scene;
}

TEST(Contacts, AreFoundWhereFacesLieOnOneAnother) {
    EXPECT_TRUE(touched(block_on(0)));
    EXPECT_TRUE(touched(block_on(3e-6)));
    EXPECT_TRUE(touched(block_on(-3e-6)));
    EXPECT_FALSE(touched(block_on(-1e-4)));
    EXPECT_FALSE(touched(block_on(0.5))) << "faces that cross";
    EXPECT_FALSE(touched(block_on(0, boundary_of({})))) << "nothing refracts";
    Scene besides = block_on(0);
    besides.instances[1].to_world[12] = 3.5;
    EXPECT_FALSE(touched(besides)) << "in one plane, but apart";
    Scene curtain = block_on(0);
    curtain.materials.back().transmission = 1;
    EXPECT_TRUE(touched(curtain)) << "thin walls count";
    Material wall = lambert(grey(1));
    wall.transmission = 1;
    EXPECT_TRUE(touched(block_on(0, wall))) << "on what is opaque, too";
}

TEST(Contacts, OfABodyWithItselfAreBackToBack) {
    Scene scene = scene_named("bodies");
    add_box(scene, glass(1.5), {-1, -1, 0}, {1, 1, 1}, Facing::outward);
    EXPECT_FALSE(touched(scene));
    add_box(scene, glass(1.33), {-1, -1, 1}, {1, 1, 2}, Facing::outward);
    EXPECT_TRUE(touched(scene));
    scene.instances[1].body = scene.instances[0].body;
    EXPECT_TRUE(touched(scene));
}

// Whichever way its faces look, and though they share corners.
TEST(Contacts, OfOneMeshAreFoundAsOfSeveral) {
    for (const double facing : {1., -1.}) {
        Scene floor = scene_named("floor");
        add_box(floor, glass(1.5), {-1, -1, 0}, {1, 1, 1}, Facing::outward);
        add_square(floor, lambert(grey(0.5F)), {0, 0, 0}, {0, 0, facing}, 2);
        floor.instances[1].body = floor.instances[0].body;
        EXPECT_TRUE(touched(floor)) << "of the same corners";
        Scene window = scene_named("window");
        Material wall = lambert(grey(1));
        wall.transmission = 1;
        add_box(window, boundary_of({}), {-1, -1, 0}, {1, 1, 1}, Facing::outward);
        add_square(window, wall, {0, 0, 1 - 1e-6}, {0, 0, facing}, 2);
        window.instances[1].body = window.instances[0].body;
        EXPECT_TRUE(touched(window));
    }
    Scene liquid = scene_named("liquid");
    add_box(liquid, glass(1.5), {-1, -1, 0}, {1, 1, 1}, Facing::outward);
    add_box(liquid, glass(1.33), {-0.5, -0.5, 1e-6}, {0.5, 0.5, 0.5}, Facing::outward);
    liquid.instances[1].body = liquid.instances[0].body;
    EXPECT_TRUE(touched(liquid)) << "both look down";
    Scene table = scene_named("side by side");
    add_square(table, glass(1.5), {0, 0, 0}, {0, 0, 1}, 2);
    add_square(table, lambert(grey(0.5F)), {2, 0, 0}, {0, 0, 1}, 2);
    EXPECT_FALSE(touched(table));
}

TEST(Contacts, AreFoundInLargeMeshes) {
    Scene scene = scene_named("spheres");
    add_icosphere(scene, glass(1.5), {0, 0, 0}, 1, 5);
    add_icosphere(scene, glass(1.33), {0, 0, 0}, 0.99, 5);
    EXPECT_FALSE(touched(scene));
    add_icosphere(scene, glass(1.33), {0, 0, 0}, 1, 5);
    EXPECT_TRUE(touched(scene));
}

LampContacts lamp_contacts_of(const Scene& scene) {
    const NormalisedScene geometry = normalise(scene);
    LightTables lights = build_light_tables(scene, geometry, LightChoice::power, false);
    return mark_lamp_contacts(
        scene, geometry, build_bvh(geometry.positions), lights.triangle_lights);
}

TEST(Contacts, OfLampsAreFoundInTheirPlane) {
    const Material lamp = lambert(grey(0), grey(1));
    const auto with = [&](const Material& other, double height, double facing) {
        Scene scene = scene_named("lamp");
        add_square(scene, other, {0, 0, height}, {0, 0, facing}, 4);
        add_square(scene, lamp, {0, 0, 0}, {0, 0, -1}, 1);
        return lamp_contacts_of(scene);
    };
    for (const double facing : {-1., 1.}) {
        EXPECT_TRUE(with(lambert(grey(1)), 0, facing).surfaces);
        EXPECT_TRUE(with(lambert(grey(1)), -3e-6, facing).surfaces);
        EXPECT_FALSE(with(lambert(grey(1)), 1e-4, facing).surfaces);
        EXPECT_FALSE(with(lambert(grey(1)), 0, facing).lamps);
        EXPECT_TRUE(with(lamp, 0, facing).surfaces);
        EXPECT_EQ(with(lamp, 0, facing).lamps, facing < 0) << "back to back they do not mix";
        EXPECT_TRUE(with(lambert(grey(0), grey(1), true), 0, facing).lamps);
    }
    EXPECT_FALSE(with(boundary_of({}), 0, 1).surfaces) << "rays pass it";
    Scene room = scene_named("floor, ceiling, lamp");
    for (const double z : {-1., 0.}) add_square(room, lambert(grey(1)), {0, 0, z}, {0, 0, 1}, 4);
    add_square(room, lamp, {0, 0, 0}, {0, 0, -1}, 1);
    const NormalisedScene geometry = normalise(room);
    std::vector<uint32_t> lights{NO_LIGHT, NO_LIGHT, NO_LIGHT, NO_LIGHT, 0, 1};
    mark_lamp_contacts(room, geometry, build_bvh(geometry.positions), lights);
    EXPECT_EQ(lights, (std::vector<uint32_t>{NO_LIGHT, NO_LIGHT, AT_LAMP, AT_LAMP, 0, 1}));
    Scene alone = scene_named("lamps side by side");
    add_square(alone, lamp, {0, 0, 0}, {0, 0, 1}, 1);
    add_square(alone, lamp, {1, 0, 0}, {0, 0, 1}, 1);
    EXPECT_FALSE(lamp_contacts_of(alone).surfaces);
}

}  // namespace
}  // namespace wavepath
