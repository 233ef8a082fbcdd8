// What a medium emits along a segment counts once, however the segment is stopped on and into
// however many paths it branches.
#include "support/media.h"
#include "support/rendering.h"

namespace wavepath {
namespace {

// Medium and walls at one temperature: walls emit (1 - rho) B, the medium sigma_a B.
TEST(MediaEmission, AtOneTemperatureIsInvisibleByEveryDistance) {
    const struct {
        Distances distances;
        Splits splits;
    } ways[] = {
        {Distances::uniform, {1, 1, 1}},
        {Distances::truncated, {3, 2, 1}},
        {Distances::equiangular, {1, 1, 1}},
        {Distances::mis, {2, 1, 1}}};
    Medium medium = medium_of(1, 0.6, 0.5);
    medium.emission = medium.sigma_a;
    Scene scene = scene_named("isothermal");
    add_box(scene, lambert(grey(0.5F), grey(0.5F)), {-2, -2, -2}, {2, 2, 2}, Facing::inward);
    add_box(scene, boundary_of(medium), {-1, -0.5, -1}, {1, 0.7, 1}, Facing::outward);
    // stops spread evenly take four times as long to .5 % as the rest together
    const Strictness strictness{.bias = 0.01, .tests = std::size(ways)};
    for (const auto& [distances, splits] : ways) {
        RenderSettings settings =
            square_settings("mis", perspective({1.7, 1, 1.6}, {0, 0, 0}, 0.6), 32, 16);
        settings.method.distances = distances;
        settings.splits = splits;
        settings.split_depth = 2;
        EXPECT_TRUE(has_mean(image_mean(render_for(strictness, scene, settings)), 1, strictness))
            << name_of(distances);
    }
}

// A plate as hot as 1 under a black sky shows what it would not reflect or transmit: 1 - R - T by
// adding-doubling, tau 1, albedo .9, along the normal.
TEST(MediaEmission, OfAPlateIsWhatItAbsorbs) {
    Medium medium = medium_of(1, 0.9);
    medium.emission = medium.sigma_a;
    Scene scene = scene_named("hot plate");
    add_slab(scene, medium);
    RenderSettings settings = square_settings("path", along(1), 16, 256);
    settings.method.distances = Distances::truncated;
    const Strictness strictness{.truth_error = 2e-6};
    EXPECT_TRUE(has_mean(
        shared_mean(render_for(strictness, scene, settings)), 1 - .26741034 - .59162509,
        strictness));
}

}  // namespace
}  // namespace wavepath
