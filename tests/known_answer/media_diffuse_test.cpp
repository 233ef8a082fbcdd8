// What plates and half-spaces return of diffuse light, by adding-doubling and Chandrasekhar's H. No
// camera sees every direction: it looks at a white speck above the plate, which gathers by
// Lambert's cosine what comes up, and by reciprocity that is the share of diffuse light.
#include "support/media.h"
#include "support/rendering.h"

namespace wavepath {
namespace {

constexpr const char* channels[] = {"R", "G", "B"};

struct Row {
    double tau, g;
    Rgb albedos;
    double reflected[3], transmitted[3];  // 0: not asked
};

// Reflected: a sky above a black floor; transmitted: a floor that shines under a black sky. The
// speck hides 10^-5 of the sky from what it sees.
Scene plate(const Row& row, bool reflects) {
    Scene scene = scene_named("plate");
    if (reflects) scene.environment = constant_environment(1);
    add_slab(scene, medium_of(row.tau, row.albedos, row.g), 400);
    add_square(scene, lambert(grey(0), grey(reflects ? 0 : 1)), {0, 0, -1.001}, {0, 0, 1}, 1000);
    add_square(scene, lambert(grey(1)), {0, 0, 0.1}, {0, 0, -1}, 3e-4);
    return scene;
}

const Camera at_the_speck = orthographic({5e-5, 2e-5, 0.05}, {5e-5, 2e-5, 0.1}, 5e-5);

void expect_shares(const std::vector<Row>& rows) {
    std::size_t tests = 0;
    for (const Row& row : rows)
        for (std::size_t c = 0; c < 3; ++c)
            tests += (row.reflected[c] > 0 ? 1U : 0U) + (row.transmitted[c] > 0 ? 1U : 0U);
    const Strictness strictness{.tests = tests, .truth_error = 3e-5};
    for (const Row& row : rows)
        for (const bool reflects : {true, false}) {
            const double* const truth = reflects ? row.reflected : row.transmitted;
            const std::size_t first = truth[0] > 0 ? 0 : truth[1] > 0 ? 1 : 2;
            if (!(truth[2] > 0)) continue;
            RenderSettings settings = square_settings("bsdf", at_the_speck, 32, 64);
            settings.method.distances = Distances::truncated;
            settings.split_depth = 3;
            // what scatters most is the noisiest of what thin plates transmit
            const std::size_t noisiest = !reflects && row.tau < 10 ? 2 : first;
            const RenderResult result =
                render_for(strictness, plate(row, reflects), settings, channels[noisiest]);
            for (std::size_t c = first; c < 3; ++c)
                EXPECT_TRUE(has_mean(shared_mean(result, channels[c]), truth[c], strictness))
                    << "tau " << row.tau << ", g " << row.g << ", albedo " << row.albedos[c]
                    << (reflects ? " reflects" : " transmits");
        }
}

TEST(MediaDiffuse, PlatesReflectAndTransmit) {
    expect_shares(
        {{0.1,
          0,
          {0.9F, 0.999F, 1},
          {.07442729, .08419653, .08429713},
          {.90595472, .91560350, .91570287}},
         {1,
          0,
          {0.5F, 0.9F, 1},
          {.13416517, .35271204, .44659401},
          {.30670882, .47474585, .55340599}},
         {10, 0, {0.999F, 1, 1}, {.87104258, .88325489, .88325489}, {}},
         {0.1, 0.75, {0.9F, 0.999F, 1}, {}, {.95405842, .96936091, .96951788}},
         {1, 0.75, {0.5F, 0.9F, 1}, {}, {.39676513, .68854764, .80802866}}});
}

// Chandrasekhar's half-space: 1 - 2 sqrt(1 - albedo) a1, a1 the first moment of H.
TEST(MediaDiffuse, HalfSpacesReflect) {
    expect_shares({{40, 0, {0.1F, 0.5F, 0.9F}, {.0216976349, .1465443807, .4780244892}, {}}});
}

// What few paths bring back: forward scattering out of thin plates, light through thick ones.
TEST(MediaDiffuse, PlatesReflectAndTransmitLittle_long) {
    WAVEPATH_SKIP_UNLESS_LONG();
    expect_shares(
        {{0.1,
          0,
          {0.5F, 0.9F, 1},
          {.03843267, .07442729, .08429713},
          {.87043785, .90595472, .91570287}},
         {1,
          0,
          {0.999F, 1, 1},
          {.44551636, .44659401, .44659401},
          {.55248682, .55340599, .55340599}},
         {10, 0, {0.5F, 0.9F, 0.999F}, {.14654438, .47801570, .87104258}, {0, 0, .10965248}},
         {10, 0, {1, 1, 1}, {}, {.11674511, .11674511, .11674511}},
         {0.1, 0.75, {0.9F, 0.999F, 1}, {.02634283, .03043913, .03048212}, {}},
         {1, 0.75, {0.5F, 0.9F, 1}, {.03954936, .13835920, .19197134}, {}},
         {1,
          0.75,
          {0.999F, 1, 1},
          {.19132375, .19197134, .19197134},
          {.80667936, .80802866, .80802866}},
         {10, 0.75, {0.5F, 0.9F, 1}, {.04401327, .24843479, .66044422}, {0, .04859337, .33955578}},
         {10,
          0.75,
          {0.999F, 1, 1},
          {.64981320, .66044422, .66044422},
          {.33054042, .33955578, .33955578}},
         {100, 0, {0.999F, 1, 1}, {.92971109, .98685346, .98685346}, {}},
         {100, 0.75, {0.999F, 1, 1}, {.86385524, .94954603, .94954603}, {}}});
}

}  // namespace
}  // namespace wavepath
