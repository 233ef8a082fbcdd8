// Directions aimed at the surroundings of lamps change the noise and nothing else.
#include "support/media.h"
#include "support/rendering.h"

#include <numbers>

namespace wavepath {
namespace {

// A room whose lamp shines up onto the ceiling 15 cm above it, as well as down: the bright patch
// there lights a good part of the room.
Scene room_with_lamp(bool glossy) {
    Scene scene = scene_named("lamp under a ceiling");
    const Material walls = lambert({0.5F, 0.3F, 0.4F});
    add_box(scene, walls, {-1, -1, -1}, {1, 1, 1}, Facing::inward);
    add_box(
        scene, lambert(grey(0), grey(5)), {-0.2, 0.84, -0.2}, {0.2, 0.85, 0.2}, Facing::outward);
    if (glossy)
        add_box(
            scene, metal({0.9F, 0.8F, 0.7F}, 0.4F), {-0.4, -0.9, -0.4}, {0.4, -0.3, 0.1},
            Facing::outward);
    return scene;
}

RenderResult render_guided(const Scene& scene, bool guide, double bias) {
    RenderSettings settings =
        square_settings("mis", perspective({0, 0, 0.9}, {0, -0.5, 0}, 0.9), 32, 64);
    settings.termination = {TerminationKind::depth, 2, 1};
    settings.method.guide = guide;
    settings.seed = guide ? 1 : 2;
    return render_for({.bias = bias / 1.5, .tests = 9}, scene, settings);
}

void expect_same_means(const Scene& scene, double bias) {
    const RenderResult guided = render_guided(scene, true, bias);
    const RenderResult plain = render_guided(scene, false, bias);
    EXPECT_TRUE(guided.guided);
    EXPECT_FALSE(plain.guided);
    for (const char* channel : {"R", "G", "B"}) {
        SCOPED_TRACE(channel);
        EXPECT_TRUE(agree(
            image_mean(guided, channel), image_mean(plain, channel), {.bias = bias, .tests = 9}));
    }
}

// S3: a grey patch two metres beside a square lamp of one metre; the lamp lights a black panel
// beside it, and so is aimed at. Another lamp on its back takes nine tenths of the light points, so
// that aimed directions weigh as much as the rest. Over a floor of 600 metres the lamp is tiny.
void expect_irradiance_of_a_square_light(double floor, double truth_error) {
    Scene scene = scene_named("square light");
    add_square(scene, lambert(grey(0), grey(1)), {0, 0, 1}, {0, 0, -1}, 1);
    add_square(scene, lambert(grey(0), grey(9)), {0, 0, 1.01}, {0, 0, 1}, 1);
    add_square(scene, lambert(grey(0)), {-0.8, 0, 0.9}, {1, 0, 0}, 0.1);
    add_square(scene, lambert(grey(0)), {0, 0, -2}, {0, 0, 1}, floor);
    add_square(scene, lambert(grey(0.5F)), {2, 1, 0}, {0, 0, 1}, 0.02);
    const RenderSettings settings =
        square_settings("mis", close_up({2, 1, 0}, {0, 0, 1}, 0.2, 2e-3), 16, 256);
    const RenderResult result = render_for({}, scene, settings);
    EXPECT_TRUE(result.guided);
    constexpr double irradiance = 0.03023651582530077;
    EXPECT_TRUE(has_mean(
        shared_mean(result), 0.5 * irradiance / std::numbers::pi, {.truth_error = truth_error}));
}

TEST(Guide, IrradianceOfASquareLight) {
    expect_irradiance_of_a_square_light(6, 1e-5);
}

TEST(Guide, IrradianceOfATinySquareLight) {
    expect_irradiance_of_a_square_light(600, 1e-4);
}

TEST(Guide, ChangesNoMeanOfDiffuseWalls) {
    expect_same_means(room_with_lamp(false), 0.0105);
}

TEST(Guide, ChangesNoMeanOfGlossyWalls) {
    expect_same_means(room_with_lamp(true), 0.0105);
}

TEST(Guide, ChangesNoMeanInFog) {
    Scene scene = room_with_lamp(false);
    add_box(
        scene, boundary_of(medium_of(0.5, 0.9, 0.5)), {-1.1, -1.1, -1.1}, {1.1, 1.1, 1.1},
        Facing::outward);
    expect_same_means(scene, 0.02);
}

// Nothing but the lamp absorbs, so the radiance is its own everywhere. Weights of aimed directions
// that multiply without end came to .4 to .6 in such rooms, in samples of any size that never came.
Scene white_room(const Medium& medium) {
    Scene scene = scene_named("white room");
    add_box(scene, lambert(grey(1)), {-1, -1, -1}, {1, 1, 1}, Facing::inward);
    add_box(scene, lambert(grey(0), grey(1)), {-0.2, 0.89, -0.2}, {0.2, 0.9, 0.2}, Facing::outward);
    add_box(scene, boundary_of(medium), {-1.1, -1.1, -1.1}, {1.1, 1.1, 1.1}, Facing::outward);
    return scene;
}

void expect_bounded_noise(const Scene& scene, double most, double bias) {
    RenderSettings settings =
        square_settings("mis", perspective({0.1, 0.1, 0.9}, {0, 0, 0}, 1), 16, 512);
    const RenderResult guided = render_scene(scene, settings);
    settings.method.guide = false;
    const RenderResult plain = render_scene(scene, settings);
    EXPECT_TRUE(guided.guided);
    EXPECT_LT(guided.film.relative_error, most * plain.film.relative_error);
    for (const RenderResult* result : {&guided, &plain})
        EXPECT_TRUE(has_mean(shared_mean(*result), 1, {.bias = bias, .tests = 2}));
}

TEST(Guide, LeavesWhiteRoomsAsTheyAre) {
    expect_bounded_noise(white_room(medium_of(0, 0)), 1.05, 0.02);
}

TEST(Guide, KeepsItsWeightsBoundedInWhiteFog) {
    expect_bounded_noise(white_room(medium_of(2, 1)), 3, 0.06);
}

}  // namespace
}  // namespace wavepath
