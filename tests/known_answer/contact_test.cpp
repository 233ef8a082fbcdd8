// What touches glass: nothing lies between the two, whichever face is met first, and though
// rounding lets them overlap here and there.
#include "scene/transform.h"
#include "support/media.h"
#include "support/rendering.h"
#include "support/textured_scenes.h"

#include <cmath>

namespace wavepath {
namespace {

constexpr double half = 400;    // [m] of the plates: at 40 what leaves by the sides adds .25 %
constexpr double least = 2e-4;  // [m] 8 10^-4 of this touches

void add_plate(Scene& scene, const Material& material, double low, double high) {
    add_box(scene, material, {-half, -half, low}, {half, half, high}, Facing::outward);
}

Scene skylit() {
    Scene scene = scene_named("contact");
    scene.environment = constant_environment(1);
    return scene;
}

void hide_below(Scene& scene) {
    add_square(scene, lambert(grey(0)), {0, 0, -5}, {0, 0, 1}, 3 * half);
}

// Reflectance at normal incidence.
double fresnel(double n) {
    return (n - 1) * (n - 1) / ((n + 1) * (n + 1));
}

// Of interfaces one behind another that absorb nothing: R / (1 - R) adds up.
double reflectance_of(std::initializer_list<double> interfaces) {
    double sum = 0;
    for (const double r : interfaces) sum += r / (1 - r);
    return sum / (1 + sum);
}

// A pane that lies on Lambert's floor of albedo rho: Rs + (1 - Rs) rho (1 - Ri) / (1 - rho Ri), Ri
// of diffuse light within n = 1.5 [Saunderson 1942]. Over a gap of air it would be .50 for .32.
TEST(Contact, PaneOnAFloor) {
    const auto diffuse = [](double rho) {
        constexpr double inside = .5963457597;
        return rho * (1 - inside) / (1 - rho * inside);
    };
    const std::pair<double, double> cases[] = {{1, .04}, {0.5, .0891867}};  // mu, Rs
    const Strictness strictness{.tests = 24, .truth_error = 1e-6};
    for (const double gap : {0.0, least, -least})
        for (const bool floor_first : {true, false})
            for (const auto& [mu, rs] : cases) {
                SCOPED_TRACE(fmt::format("gap {}, floor first {}, mu {}", gap, floor_first, mu));
                Scene scene = skylit();
                const auto add_floor = [&] {
                    add_square(scene, lambert({0.5F, 0.8F, 0}), {0, 0, -1}, {0, 0, 1}, 2 * half);
                };
                if (floor_first) add_floor();
                add_plate(scene, glass(1.5), -1 + gap, 0);
                if (!floor_first) add_floor();
                const RenderResult result =
                    render_for(strictness, scene, square_settings("mis", along(mu), 16, 64));
                const auto [r, g] = std::pair(diffuse(0.5), diffuse(0.8));
                EXPECT_TRUE(has_mean(shared_mean(result, "R"), rs + (1 - rs) * r, strictness));
                EXPECT_TRUE(has_mean(shared_mean(result, "G"), rs + (1 - rs) * g, strictness));
            }
}

// A block that its node turns, on a floor whose corners are turned already: rounding has the two
// planes cross. The same as a block that reaches into the floor.
TEST(Contact, TurnedBlockOnAFloor) {
    const Matrix4 turn = compose({0, 0, 0}, {.0886, .1772, .2658, .9429}, {1, 1, 1});
    const Strictness strictness{.bias = .01, .tests = 6};
    for (const float roughness : {0.0F, 0.3F}) {
        const auto mean = [&](double low) {
            Scene scene = skylit();
            Material block = glass(1.5);
            block.roughness = roughness;
            add_box(scene, block, {-1, -1, low}, {1, 1, 0.5}, Facing::outward);
            scene.instances[0].to_world = turn;
            Primitive& floor = add_square(scene, lambert(grey(0.8F)), {0, 0, 0}, {0, 0, 1}, 10);
            for (std::size_t corner = 0; corner < 4; ++corner) {
                const Vec3d p = transform_point(turn, vec3_at(floor.positions, corner));
                for (std::size_t k = 0; k < 3; ++k)
                    floor.positions[3 * corner + k] = static_cast<float>(p[k]);
            }
            const Camera camera = perspective(
                transform_point(turn, {0.5, 1, 4}), transform_point(turn, {0, 0, 0.2}), 0.3);
            return image_mean(render_for(
                {.bias = .01 / 1.5, .tests = 6}, scene, square_settings("mis", camera, 16, 64)));
        };
        const Estimate embedded = mean(-0.1);
        constexpr double touching = 10 * 0x1p-20;  // [m]
        for (const double low : {0.0, 0.5 * touching, 0.9 * touching})
            EXPECT_TRUE(agree(mean(low), embedded, strictness)) << low << ", " << roughness;
    }
}

// Glass, a liquid, and glass: four interfaces, of which the inner reflect .0036 each. With air
// between they would be six of .04.
TEST(Contact, LiquidBetweenPanes) {
    const double inner = fresnel(1.5 / 1.33);
    const double truth = reflectance_of({.04, inner, inner, .04});
    const Strictness strictness{.bias = .02, .tests = 2};
    for (const bool liquid_first : {true, false}) {
        Scene scene = skylit();
        hide_below(scene);
        if (liquid_first) add_plate(scene, glass(1.33), -2, -1);
        add_plate(scene, glass(1.5), -1, 0);
        add_plate(scene, glass(1.5), -3, -2);
        if (!liquid_first) add_plate(scene, glass(1.33), -2, -1);
        EXPECT_TRUE(has_mean(
            shared_mean(render_for(strictness, scene, square_settings("mis", along(1), 16, 256))),
            truth, strictness))
            << liquid_first;
    }
}

// Fog of optical depth .5 on a pane: what the pane reflects passes through it twice.
TEST(Contact, FogOnAPane) {
    const double truth = reflectance_of({.04, .04}) * std::exp(-1);
    const Strictness strictness{.bias = .02, .tests = 6};
    for (const double gap : {0.0, least, -least})
        for (const bool fog_first : {true, false}) {
            Scene scene = skylit();
            hide_below(scene);
            const auto add_fog = [&] { add_plate(scene, boundary_of(medium_of(0.5, 0)), gap, 1); };
            if (fog_first) add_fog();
            add_plate(scene, glass(1.5), -1, 0);
            if (!fog_first) add_fog();
            EXPECT_TRUE(has_mean(
                shared_mean(render_for(
                    strictness, scene,
                    square_settings(
                        "mis", orthographic({0.1, 0.03, 2}, {0.1, 0.03, 0}, 0.01), 16, 256))),
                truth, strictness))
                << "gap " << gap << ", fog first " << fog_first;
        }
}

// Of two bodies with the same faces the later fills both: absorbing glass
// (`Dielectric.PaneReflectsAndTransmits`), or fog that has the index of the glass, so dense (3 per
// metre) that nothing comes back from below.
TEST(Contact, FogAndGlassOfTheSameFaces) {
    const Strictness strictness{.bias = .02, .tests = 2, .truth_error = 1e-6};
    for (const bool glass_last : {true, false}) {
        Scene scene = skylit();
        hide_below(scene);
        if (!glass_last) add_plate(scene, glass(1.5, medium_of(0.5, 0)), -1, 0);
        add_plate(scene, boundary_of(medium_of(3, 0)), -1, 0);
        if (glass_last) add_plate(scene, glass(1.5, medium_of(0.5, 0)), -1, 0);
        const RenderSettings settings = square_settings("mis", along(0.5), 16, 256);
        const double once = .0891866779;  // Fresnel at 60 degrees
        const double passes = std::exp(-2 * 3 / std::sqrt(2. / 3));
        const double fog = once + (1 - once) * (1 - once) * once * passes;
        EXPECT_TRUE(has_mean(
            shared_mean(render_for(strictness, scene, settings)), glass_last ? .110977612649 : fog,
            strictness));
    }
}

// A filter below a pane, before something white-hot: it tints what passes, going in and going out,
// and nothing that the pane reflects.
TEST(Contact, TintsWhatPasses) {
    const double truth = 1 - reflectance_of({.04, .04});
    const Strictness strictness{.bias = .01, .tests = 6};
    for (const bool textured : {false, true})
        for (const bool pane_first : {true, false}) {
            Scene scene = scene_named("filter");
            Material filter = boundary_of({});
            filter.base_color = {0.5F, 1, 1};
            add_square(scene, lambert(grey(0), grey(1)), {0, 0, -5}, {0, 0, 1}, 3 * half);
            if (pane_first) add_plate(scene, glass(1.5), -1, 0);
            add_plate(scene, filter, -2, -1);
            if (textured) {
                Primitive& primitive = scene.primitives.back();
                primitive.uvs[0].assign(primitive.positions.size() / 3 * 2, 0.5F);
                add_texture(
                    scene, scene.materials.back(), TEXTURE_BASE_COLOR,
                    image_of(1, 1, {255, 188, 255, 255}));
            }
            if (!pane_first) add_plate(scene, glass(1.5), -1, 0);
            const RenderResult result =
                render_for(strictness, scene, square_settings("mis", along(1), 16, 256));
            const double once = textured ? 188 / 255. : 1;
            EXPECT_TRUE(has_mean(shared_mean(result, "R"), truth * 0.25, strictness));
            EXPECT_TRUE(has_mean(shared_mean(result, "G"), truth * once * once, strictness));
        }
}

// A lamp under a plate of glass that scatters, or a little below it: connections from within end at
// the lamp, not at the face that lies in its plane.
TEST(Contact, LampUnderTurbidGlass) {
    const Strictness strictness{.bias = .02, .tests = 2};
    const Strictness each{.bias = .02 / 1.5, .tests = 2};
    constexpr double gap = 1e-6;  // [m] 3.8 10^-6 touches
    for (const bool lamp_first : {true, false}) {
        Scene scene = scene_named("lamp");
        const auto add_lamp = [&] {
            add_square(scene, lambert(grey(0), grey(1)), {0, 0, -1}, {0, 0, 1}, 4);
        };
        if (lamp_first) add_lamp();
        add_box(
            scene, glass(1.5, medium_of(2, 0.8)), {-1, -1, -1 + gap}, {1, 1, 0}, Facing::outward);
        if (!lamp_first) add_lamp();
        const auto mean = [&](const char* method) {
            return shared_mean(render_for(each, scene, square_settings(method, along(1), 16, 64)));
        };
        EXPECT_TRUE(agree(mean("mis"), mean("path"), strictness)) << lamp_first;
    }
}

// A rough pane on what holds a lamp, fog that its boundary tints or a liquid: connections from the
// pane's lower face lie in it and carry its tint, as the paths do that light points know nothing
// of.
TEST(Contact, LampBelowARoughPaneIsLitAlike) {
    Medium absorbing = medium_of(0, 0);
    absorbing.sigma_a = {0.2F, 1, 0};
    Material pane = glass(1.5);
    pane.roughness = 0.5F;
    Material fog = boundary_of(absorbing);
    fog.base_color = {0.4F, 1, 1};
    Material liquid = glass(1.33, absorbing);
    liquid.roughness = pane.roughness;  // of two faces in one plane either may be met
    const struct {
        const char* what;
        const Material& below;
        const char* method;
    } cases[] = {{"fog", fog, "direct"}, {"fog", fog, "mis"}, {"liquid", liquid, "mis"}};
    const Strictness strictness{.bias = .02, .tests = 2 * std::size(cases)};
    for (const auto& [what, below, method] : cases) {
        Scene scene = scene_named("lamp");
        add_box(scene, pane, {-2, -2, -0.1}, {2, 2, 0}, Facing::outward);
        add_box(scene, below, {-2, -2, -2}, {2, 2, -0.1}, Facing::outward);
        add_square(scene, lambert(grey(0), grey(1)), {0, 0, -1}, {0, 0, 1}, 1);
        const auto lit = [&](const char* by) {
            const Strictness each{.bias = .02 / 1.5, .tests = strictness.tests};
            return render_for(each, scene, square_settings(by, along(1), 16, 256), "G");
        };
        const RenderResult connected = lit(method);
        const RenderResult met = lit("bsdf");
        for (const char* channel : {"R", "G"})
            EXPECT_TRUE(
                agree(shared_mean(connected, channel), shared_mean(met, channel), strictness))
                << what << ", " << method << ", " << channel;
    }
}

}  // namespace
}  // namespace wavepath
