// Paths that nothing ends: roulette ends them in time, and where it may not they are cut at a
// limit, counted and located.
#include "build_paths.h"
#include "support/command.h"
#include "support/environment_variable.h"
#include "support/media.h"
#include "support/rendering.h"

#include "image/exr_writer.h"

#include <gmock/gmock.h>

#include <fstream>
#include <limits>
#include <sstream>

namespace wavepath {
namespace {

namespace fs = std::filesystem;

const Camera inside = perspective({0.2, 0.1, 0.3}, {-1, -0.4, -0.9}, 1.6);

Scene white_room(float albedo, float emission) {
    Scene scene = scene_named("white room");
    add_box(scene, lambert(grey(albedo), grey(emission)), {-1, -1, -1}, {1, 1, 1}, Facing::inward);
    scene.environment = constant_environment(1);  // unseen: every scene needs a light
    return scene;
}

RenderSettings settings_of(const Termination& termination, uint32_t size, uint64_t samples) {
    RenderSettings settings = square_settings("bsdf", inside, size, samples);
    settings.termination = termination;
    return settings;
}

// A folder of kernels with one text replaced in each of some files.
struct Replacement {
    std::string file, text, by;
};

void write_kernels(const TemporaryFolder& folder, const std::vector<Replacement>& replacements) {
    fs::copy(WAVEPATH_SOURCE_DIR "/kernels", folder.path(), fs::copy_options::recursive);
    for (const auto& [file, text, by] : replacements) {
        std::ostringstream content;
        content << std::ifstream(folder / file).rdbuf();
        std::string changed = content.str();
        const std::size_t at = changed.find(text);
        ASSERT_NE(at, std::string::npos) << file << ": no " << text;
        std::ofstream(folder / file, std::ios::trunc) << changed.replace(at, text.size(), by);
    }
}

// 50 instead of 10^6 scatterings, so that it takes no time.
const std::vector<Replacement> short_limit{
    {"shared/queues.h", "1000000u", "50u"},
    {"stages/sample_indirect.cl", "params.max_scatterings", "MAX_SCATTERINGS"}};

const Termination zero{TerminationKind::zero, 0, 1};

TEST(LongPath, OfWhiteWallsEndsByRoulette) {
    const RenderResult result = render_scene(white_room(1, 1), settings_of({}, 8, 4));
    EXPECT_EQ(result.cut_paths.count, 0U);
    EXPECT_LT(result.iterations, 20000U);
}

// L = 1 / (1 - rho): a third of it comes by paths of more than 1000 scatterings.
TEST(LongPath, IsEndedWithoutBias) {
    const Strictness strictness{.bias = 0.02};
    const RenderResult result =
        render_for(strictness, white_room(0.999F, 1), settings_of({}, 32, 4));
    EXPECT_TRUE(has_mean(shared_mean(result), 1000, strictness));
}

TEST(LongPath, ThatIsNoNumberEndsAtOnceAndIsCounted) {
    const RenderResult result = render(
        test_device(), white_room(std::numeric_limits<float>::quiet_NaN(), 1),
        settings_of(zero, 4, 5));
    EXPECT_EQ(result.film.nonfinite.samples, 4U * 4 * 5);
    EXPECT_EQ(result.cut_paths.count, 0U);
    EXPECT_LT(result.iterations, 20U);
}

// What a cut path has gathered before stays in the picture: 51 times what the walls emit.
TEST(LongPath, IsCutAtTheLimit) {
    const TemporaryFolder folder;
    write_kernels(folder, short_limit);
    const EnvironmentVariable kernels("WAVEPATH_KERNELS", folder.path().string());
    const RenderSettings settings = settings_of(zero, 4, 5);
    const RenderResult result = render_scene(white_room(1, 1), settings);
    EXPECT_EQ(result.samples, 5U);
    EXPECT_FALSE(result.interrupted);
    EXPECT_EQ(result.cut_paths.count, 4U * 4 * 5);
    EXPECT_EQ(result.cut_paths.x, 0U);
    EXPECT_EQ(result.cut_paths.y, 0U);
    EXPECT_EQ(result.cut_paths.sample, 0U);
    EXPECT_NEAR(image_mean(result).mean, 51, 1e-3);
    EXPECT_THAT(bias_of(settings, result), testing::StartsWith("biased: 80 paths were cut after"));
}

TEST(LongPath, IsCutAfterAMillionScatterings_long) {
    WAVEPATH_SKIP_UNLESS_LONG();
    const RenderResult result = render_scene(white_room(1, 1e-3F), settings_of(zero, 1, 1));
    EXPECT_EQ(result.cut_paths.count, 1U);
    EXPECT_NEAR(image_mean(result).mean, 1000, 1);
}

// Samples 37 and 50 of the pixel (5, 3) and one of (6, 3); index 37 with its bits reversed is
// 0xa4000000. In whatever order they end, and by --splits too, where another child goes on.
TEST(LongPath, IsLocatedWhateverTheOrderOfWork) {
    const TemporaryFolder folder;
    write_kernels(
        folder, {{"stages/roulette_compact.cl",
                  "(primitive == HIT_ENDED) & (scattering >= MAX_SCATTERINGS)",
                  "ends & (scattering == 3u) & (PLANE(ids, ID_PIXEL)[slot] == 53u | PLANE(ids, "
                  "ID_PIXEL)[slot] == 54u) & (PLANE(ids, ID_INDEX)[slot] == 0xa4000000u | "
                  "PLANE(ids, ID_INDEX)[slot] == 0x4c000000u)"}});
    const EnvironmentVariable kernels("WAVEPATH_KERNELS", folder.path().string());
    for (const uint32_t pool : {64U, 1024U, 16384U})
        for (const uint32_t splits : {1U, 2U}) {
            SCOPED_TRACE(testing::Message() << "pool " << pool << ", splits " << splits);
            RenderSettings settings = settings_of({TerminationKind::depth, 3, 1}, 16, 64);
            settings.pool = pool;
            settings.splits.reflections = splits;
            const RenderResult result = render_scene(white_room(0.9F, 1), settings);
            EXPECT_EQ(result.cut_paths.count, 4U * splits);
            EXPECT_EQ(result.cut_paths.x, 5U);
            EXPECT_EQ(result.cut_paths.y, 3U);
            EXPECT_EQ(result.cut_paths.sample, 37U);
        }
}

class LongPathCommand : public CommandTest {};

TEST_F(LongPathCommand, WritesThePictureAndSaysThatPathsWereCut) {
    const TemporaryFolder kernels;
    write_kernels(kernels, short_limit);
    const Outcome outcome =
        run("render " WAVEPATH_SOURCE_DIR
            "/scenes/white_furnace/scene.gltf --size 4x4 --spp 2 "
            "--termination zero --quiet -o " +
                path("a.exr") + " --json " + path("a.json"),
            "WAVEPATH_KERNELS=" + kernels.path().string());
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(std::ranges::count(outcome.words, '\n'), 1) << outcome.words;
    EXPECT_THAT(
        outcome.words,
        testing::ContainsRegex(
            "32 paths were cut .* pixel \\(0, 0\\), sample 0: .*--termination roulette or "
            "roulette:q, which are unbiased, or depth:D"));
    const nlohmann::json report = json("a.json");
    EXPECT_EQ(report["cut_paths"], 32);
    EXPECT_EQ(report["first_cut"]["sample"], 0);
    EXPECT_EQ(report["interrupted"], false);
    EXPECT_EQ(report["bias"], read_exr(path("a.exr")).metadata.at("wavepath.bias"));
    EXPECT_THAT(report["bias"].get<std::string>(), testing::HasSubstr("32 paths were cut"));
}

}  // namespace
}  // namespace wavepath
