// Numbers that are none, put into the kernels one at a time: every sample that holds one is
// counted.
#include "build_paths.h"
#include "support/environment_variable.h"
#include "support/media.h"
#include "support/rendering.h"
#include "support/temporary_folder.h"

#include <fstream>
#include <sstream>

namespace wavepath {
namespace {

namespace fs = std::filesystem;

// Half of the picture: columns 8 to 15 of 16.
const std::string right_half = "(PLANE(ids, ID_PIXEL)[slot] % 16u >= 8u ? NAN : 1.0f)";

NonFinite spoilt_by(
    const std::string& file,
    const std::string& text,
    const std::string& replacement,
    uint64_t samples = 4) {
    const TemporaryFolder folder;
    const fs::path kernels = folder / "kernels";
    fs::copy(WAVEPATH_SOURCE_DIR "/kernels", kernels, fs::copy_options::recursive);
    std::ostringstream content;
    content << std::ifstream(kernels / file).rdbuf();
    std::string source = content.str();
    const std::size_t at = source.find(text);
    if (at == std::string::npos) {
        ADD_FAILURE() << file << ": no '" << text << "' any more";
        return {};
    }
    source.replace(at, text.size(), replacement);
    std::ofstream(kernels / file) << source;

    const EnvironmentVariable variable("WAVEPATH_KERNELS", kernels.string());
    Scene scene = scene_named("lit floor");
    add_square(scene, lambert(grey(0.5F)), {0, 0, 0}, {0, 0, 1}, 4);
    add_square(scene, lambert(grey(0), grey(1)), {0, 0, 1}, {0, 0, -1}, 0.5);
    RenderSettings settings =
        square_settings("mis", orthographic({0, 0, 0.5}, {0, 0, 0}, 0.1), 16, samples);
    settings.termination = {TerminationKind::depth, 1, 1};
    return render(test_device(), scene, settings).film.nonfinite;
}

constexpr uint64_t half = 16ULL * 8 * 4;

TEST(NonFinite, ConnectionsAreCounted) {
    EXPECT_EQ(
        spoilt_by(
            "stages/direct_light.cl", "    // A product of steps",
            "    value = scale3(value, " + right_half + ");\n    // A product of steps")
            .samples,
        half);
}

TEST(NonFinite, DirectionsAreCounted) {
    EXPECT_EQ(
        spoilt_by(
            "stages/sample_indirect.cl", "to_world(frame, s.wi)",
            "scale3(to_world(frame, s.wi), " + right_half + ")")
            .samples,
        half);
}

TEST(NonFinite, ThroughputsAreCounted) {
    EXPECT_EQ(
        spoilt_by(
            "stages/sample_indirect.cl", "mul3(child.carried, weight)",
            "scale3(mul3(child.carried, weight), " + right_half + ")")
            .samples,
        half);
}

// Samples 37 and 50 of the pixel (5, 3): index 37 with its bits reversed is 0xa4000000.
TEST(NonFinite, TheFirstSampleIsNamed) {
    const NonFinite found = spoilt_by(
        "stages/sample_indirect.cl", "mul3(child.carried, weight)",
        "scale3(mul3(child.carried, weight), PLANE(ids, ID_PIXEL)[slot] == 53u & "
        "(PLANE(ids, ID_INDEX)[slot] == 0xa4000000u | PLANE(ids, ID_INDEX)[slot] == 0x4c000000u) "
        "? NAN : 1.0f)",
        64);
    EXPECT_EQ(found.samples, 2U);
    EXPECT_EQ(found.x, 5U);
    EXPECT_EQ(found.y, 3U);
    EXPECT_EQ(found.sample, 37U);
}

// A body of fog beside the floor has nothing to do with it.
TEST(NonFinite, MediaAreNotBlamedForLights) {
    Scene scene = scene_named("glaring");
    add_square(scene, lambert(grey(0.5F)), {0, 0, 0}, {0, 0, 1}, 4);
    add_box(scene, boundary_of(medium_of(1, 0.5)), {1, 1, 0.5}, {1.5, 1.5, 1}, Facing::outward);
    PunctualLight light;
    light.position = {0, 0, 0.1};
    light.intensity = grey(3e38F);
    scene.lights = {light};
    const RenderResult result = render(
        test_device(), scene,
        square_settings("mis", orthographic({0, 0, 0.05}, {0, 0, 0}, 0.1), 4, 1));
    EXPECT_EQ(result.film.nonfinite.samples, 16U);
    EXPECT_FALSE(result.film.nonfinite.of_media);
    ASSERT_EQ(result.warnings.size(), 1U);
    EXPECT_EQ(
        result.warnings[0],
        "glaring: samples are not finite, and why is not known; dim lights whose radiance may "
        "exceed 32 bits, else report the scene");
}

}  // namespace
}  // namespace wavepath
