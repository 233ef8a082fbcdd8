// The table of plates by adding-doubling, R and T apart: a sky above a black floor, a floor that
// shines under a black sky.
#include "support/media.h"
#include "support/rendering.h"

namespace wavepath {
namespace {

constexpr const char* channels[] = {"R", "G", "B"};

// R and T apart, three albedos at once, over the table of adding-doubling. Transmissions below .03
// are 0 here: they would take 10^9 to 10^10 scatterings each.
constexpr Rgb albedos{0.5F, 0.9F, 0.999F};

struct Row {
    double g, tau, mu;
    double reflected[3], transmitted[3];

    // what takes 2 10^7 samples at most: plates of a free path in which most scatters back or
    // through
    bool is_quick(bool reflects) const {
        return tau == 1 && (reflects ? reflected[0] > .09 : transmitted[0] > .2);
    }
};

constexpr Row rows[] = {
    {0, 0.1, 1, {.02173299, .04210143, .04763164}, {.92646510, .94674644, .95225469}},
    {0, 0.1, 0.5, {.04149825, .08037954, .09093449}, {.85982802, .89837766, .90884898}},
    {0, 0.1, 0.1, {.14748245, .28532082, .32268949}, {.50847775, .64062268, .67655569}},
    {0, 1, 1, {.09911919, .26741034, .34047630}, {.44605839, .59162509, .65789038}},
    {0, 1, 0.5, {.14975384, .39366166, .49717377}, {.23028520, .41483990, .50060946}},
    {0, 1, 0.1, {.23875898, .56898766, .69621842}, {.07119222, .22575328, .30143056}},
    {0, 10, 1, {.11522588, .41493469, .83887554}, {0, 0, .13824605}},
    {0, 10, 0.5, {.16014443, .50793197, .88697113}, {0, 0, .09548403}},
    {0, 10, 0.1, {.24172078, .62933176, .92913199}, {0, 0, .05913786}},
    {0.75, 0.1, 1, {.00292173, .00599221, .00688488}, {.94743083, .98369593, .99301096}},
    {0.75, 0.1, 0.5, {.01190360, .02511008, .02905687}, {.88993702, .95378949, .97072802}},
    {0.75, 0.1, 0.1, {.10785372, .22509643, .25976585}, {.52752178, .69211270, .73937807}},
    {0.75, 1, 1, {.01510894, .05594682, .07846322}, {.56461223, .82791736, .92024345}},
    {0.75, 1, 0.5, {.04634730, .17103869, .23963732}, {.30646664, .62234188, .75795116}},
    {0.75, 1, 0.1, {.16670684, .45192169, .57996659}, {.06749877, .29269231, .41700577}},
    {0.75, 10, 1, {.01952816, .16470697, .55781243}, {0, .07375501, .42040564}},
    {0.75, 10, 0.5, {.05106944, .28488055, .69458700}, {0, .03666475, .28673391}},
    {0.75, 10, 0.1, {.16770559, .50467232, .82839960}, {0, 0, .15962435}}};

void expect_table(bool quick) {
    for (const Row& row : rows)
        for (const bool reflects : {true, false}) {
            if (row.is_quick(reflects) != quick) continue;
            Scene scene = scene_named("table");
            if (reflects) scene.environment = constant_environment(1);
            add_mirrored_slab(scene, medium_of(row.tau, albedos, row.g));
            add_floor(scene, lambert(grey(0), grey(reflects ? 0 : 1)));
            const double* truth = reflects ? row.reflected : row.transmitted;
            const std::size_t first = truth[0] > 0 ? 0 : truth[1] > 0 ? 1 : 2;
            const Strictness strictness{.tests = 6 * std::size(rows), .truth_error = 5e-7};
            RenderSettings settings = square_settings("bsdf", along(row.mu), 64, 64);
            settings.method.distances = Distances::truncated;
            settings.split_depth = row.tau < 10 ? 2 : 1;
            const RenderResult result = render_for(strictness, scene, settings, channels[first]);
            for (std::size_t c = first; c < 3; ++c)
                EXPECT_TRUE(has_mean(shared_mean(result, channels[c]), truth[c], strictness))
                    << "g " << row.g << ", tau " << row.tau << ", mu " << row.mu << ", albedo "
                    << albedos[c] << (reflects ? " reflects" : " transmits");
        }
}

TEST(MediaSlab, ReflectsAndTransmitsByTheTable) {
    expect_table(true);
}

TEST(MediaSlab, ReflectsAndTransmitsByTheRestOfTheTable_long) {
    WAVEPATH_SKIP_UNLESS_LONG();
    expect_table(false);
}

// The rest of that table: albedos .999 and 1, of which the second loses nothing, to tau 100.
TEST(MediaSlab, ReflectsWithLittleAbsorptionOrNone_long) {
    WAVEPATH_SKIP_UNLESS_LONG();
    const struct {
        double g, tau;
        double reflected[3][2];  // mu 1, .5, .1; albedo .999 (0: asked above), 1
    } rows[] = {
        {0, 1, {{0, .34132876}, {0, .49837553}, {0, .69766420}}},
        {0, 10, {{0, .85300462}, {0, .89824975}, {0, .93694379}}},
        {0, 100, {{.91284256, .98344695}, {.93805895, .98854202}, {.96077314, .99289931}}},
        {0.75, 1, {{0, .07873981}, {0, .24047990}, {0, .58147993}}},
        {0.75, 10, {{0, .56897538}, {0, .70503344}, {0, .83557613}}},
        {0.75, 100, {{.83001927, .93594003}, {.88026778, .95617453}, {.93176693, .97556979}}}};
    constexpr double mus[] = {1, 0.5, 0.1};
    const Strictness strictness{.tests = 24, .truth_error = 5e-7};
    for (const auto& [g, tau, reflected] : rows)
        for (std::size_t k = 0; k < 3; ++k) {
            Scene scene = scene_named("table");
            scene.environment = constant_environment(1);
            add_mirrored_slab(scene, medium_of(tau, Rgb{0.999F, 1, 1}, g));
            add_floor(scene, lambert(grey(0)));
            const std::size_t first = reflected[k][0] > 0 ? 0 : 1;
            const RenderResult result = render_for(
                strictness, scene, square_settings("bsdf", along(mus[k]), 64, 16), channels[first]);
            for (std::size_t c = first; c < 2; ++c)
                EXPECT_TRUE(has_mean(shared_mean(result, channels[c]), reflected[k][c], strictness))
                    << "g " << g << ", tau " << tau << ", mu " << mus[k] << ", " << channels[c];
        }
}

// Three angles of one plate that loses nothing: what it transmits, and what the thinnest reflect.
TEST(MediaSlab, TransmitsWithoutAbsorption_long) {
    WAVEPATH_SKIP_UNLESS_LONG();
    constexpr double mus[] = {1, 0.5, 0.1};
    const struct {
        double g, tau;
        bool reflects;
        double truth[3];
    } rows[] = {
        {0, 0.1, true, {.04768859, .09104318, .32307418}},
        {0, 0.1, false, {.95231141, .90895682, .67692582}},
        {0.75, 0.1, true, {.00689421, .02909834, .26012935}},
        {0.75, 0.1, false, {.99310579, .97090166, .73987065}},
        {0, 1, false, {.65867124, .50162447, .30233580}},
        {0.75, 1, false, {.92126019, .75952010, .41852007}},
        {0, 10, false, {.14699538, .10175025, .06305621}},
        {0.75, 10, false, {.43102462, .29496656, .16442387}}};
    const Strictness strictness{.tests = 24, .truth_error = 5e-7};
    for (const auto& [g, tau, reflects, truth] : rows)
        for (std::size_t k = 0; k < 3; ++k) {
            Scene scene = scene_named("table");
            if (reflects) scene.environment = constant_environment(1);
            add_mirrored_slab(scene, medium_of(tau, 1, g));
            add_floor(scene, lambert(grey(0), grey(reflects ? 0 : 1)));
            RenderSettings settings = square_settings("bsdf", along(mus[k]), 64, 64);
            if (tau < 1) settings.method.distances = Distances::truncated;
            settings.split_depth = tau < 1 ? 2 : 1;
            EXPECT_TRUE(has_mean(
                shared_mean(render_for(strictness, scene, settings)), truth[k], strictness))
                << "g " << g << ", tau " << tau << ", mu " << mus[k]
                << (reflects ? " reflects" : " transmits");
        }
}

// Forward scattering in what lets nothing through.
TEST(MediaSlab, ReflectsForwardScatteringFromTheDeep_long) {
    WAVEPATH_SKIP_UNLESS_LONG();
    constexpr Rgb albedos{0.5F, 0.9F, 0.9F};
    const struct {
        double mu;
        double truth[2];
    } cases[] = {
        {1, {.01952817, .16551715}}, {0.5, {.05106945, .28528465}}, {0.1, {.16770559, .50487012}}};
    Scene scene = scene_named("table");
    scene.environment = constant_environment(1);
    add_mirrored_slab(scene, medium_of(100, albedos, 0.75));
    const Strictness strictness{.tests = 6, .truth_error = 5e-7};
    for (const auto& [mu, truth] : cases) {
        const RenderResult result =
            render_for(strictness, scene, square_settings("bsdf", along(mu), 64, 64));
        for (std::size_t c = 0; c < 2; ++c)
            EXPECT_TRUE(has_mean(shared_mean(result, channels[c]), truth[c], strictness))
                << "mu " << mu << ", albedo " << albedos[c];
    }
}

}  // namespace
}  // namespace wavepath
