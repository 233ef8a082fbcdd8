// A fifth medium around a path is found where glass begins one, too: samples are not finite.
#include "support/media.h"
#include "support/rendering.h"

namespace wavepath {
namespace {

constexpr double gap = 1e-6;  // [m] 4 10^-6 touches

// Boxes that reach through one another, so that none lies in others, whose tops a camera above
// meets one after the other: fogs, then glass, and in the glass, touching its face, another fog or
// none.
Scene crossing(int fogs, bool touched, bool lamp_touches) {
    Scene scene = scene_named("crossing");
    const auto add = [&](const Material& material, double side, double height) {
        add_box(scene, material, {-side, -side, -height}, {side, side, height}, Facing::outward);
    };
    add(glass(1.5, medium_of(0.1, 0)), 1, 1);
    if (touched) add(boundary_of(medium_of(0.2, 0)), 0.95, 1 - gap);
    for (int k = 0; k < fogs; ++k)
        add(boundary_of(medium_of(0.3 + 0.1 * k, 0)), 0.9 - 0.05 * k, 1.1 + 0.1 * k);
    const double lamp = lamp_touches ? -1 : -2;
    add_square(scene, lambert(grey(0), grey(1)), {0, 0, lamp}, {0, 0, 1}, 4);
    return scene;
}

uint64_t nonfinite_samples(const Scene& scene) {
    return render(
               test_device(), scene,
               square_settings("path", orthographic({0, 0, 2}, {0.01, 0.02, 0}, 0.1), 8, 16))
        .film.nonfinite.samples;
}

// Where nothing touches the glass, where something else does, and where the fifth does.
TEST(MediaBoundary, OfAFifthMediumIsFoundBehindGlass) {
    for (const int media : {4, 5}) {
        EXPECT_EQ(nonfinite_samples(crossing(media - 1, false, false)) > 0, media == 5) << media;
        EXPECT_EQ(nonfinite_samples(crossing(media - 1, false, true)) > 0, media == 5) << media;
        EXPECT_EQ(nonfinite_samples(crossing(media - 2, true, false)) > 0, media == 5) << media;
    }
}

}  // namespace
}  // namespace wavepath
