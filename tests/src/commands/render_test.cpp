// The program as a user meets it: exit codes, what it writes, and when it stops.
#include "build_paths.h"
#include "image/exr_writer.h"
#include "support/render_command.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>

namespace wavepath {
namespace {

using testing::HasSubstr;

TEST_F(RenderCommand, WritesPicturesAndAReport) {
    const Outcome outcome =
        run("render " + cornell_box + " --size 16x8 --spp 8 --seed 3 -o " + path("a.exr") + " " +
            path("a.png") + " --json " + path("a.json"));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.words;
    const Image image = read_exr(path("a.exr"));
    EXPECT_EQ(image.width, 16U);
    EXPECT_EQ(image.height, 8U);
    EXPECT_EQ(image.channels.size(), 13U);
    EXPECT_EQ(image.metadata.at("wavepath.samples"), "8");
    EXPECT_EQ(image.metadata.at("wavepath.bias"), "none");
    EXPECT_TRUE(std::filesystem::exists(path("a.png")));
    const nlohmann::json report = json("a.json");
    EXPECT_EQ(report["schema"], 1);
    EXPECT_EQ(report["scene"]["name"], cornell_box);
    EXPECT_EQ(report["scene"]["triangles"], 36);
    EXPECT_EQ(report["bias"], "");
    EXPECT_TRUE(report["program_build"]["from_own_cache"].is_boolean());
    EXPECT_EQ(report["samples_per_pixel"], 8);
    EXPECT_GT(report["memory_bytes"]["host_peak"], report["memory_bytes"]["device_film"]);
    // both say alike what was asked for
    nlohmann::json settings = report["settings"];
    settings.erase("pool");  // decides no picture
    EXPECT_EQ(nlohmann::json::parse(image.metadata.at("wavepath.settings")), settings);
    EXPECT_EQ(report["settings"]["seed"], 3);
    EXPECT_EQ(report["nonfinite_samples"], 0);
    uint64_t paths = 0;
    for (const auto& n : report["path_lengths"]) paths += n.get<uint64_t>();
    EXPECT_EQ(paths, 16U * 8U * 8U);
}

// What other programs make of the file: OpenImageIO's tool and OpenEXR's own.
TEST_F(RenderCommand, WritesOpenExrThatOthersRead) {
    if (std::system("command -v oiiotool > /dev/null && command -v exrheader > /dev/null") != 0)
        GTEST_SKIP() << "oiiotool and exrheader are not installed";
    run("render " + cornell_box + " --size 16x8 --spp 4 --quiet -o " + path("a.exr"));
    const auto words_of = [&](const std::string& tool) {
        EXPECT_EQ(std::system((tool + " " + path("a.exr") + " > " + path("words")).c_str()), 0);
        return folder.read("words");
    };
    const std::string oiio = words_of("oiiotool --info -v --stats");
    EXPECT_THAT(oiio, HasSubstr("16 x    8, 13 channel, float openexr"));
    EXPECT_THAT(oiio, HasSubstr("channel list: R, G, B, "));
    EXPECT_THAT(oiio, HasSubstr("wavepath.samples: \"4\""));
    EXPECT_THAT(oiio, HasSubstr("NanCount: 0 0 0 0"));
    const std::string openexr = words_of("exrheader");
    EXPECT_THAT(openexr, HasSubstr("depth.Z, 32-bit floating-point"));
    EXPECT_THAT(openexr, HasSubstr("wavepath.method (type string): \"mis\""));
}

TEST_F(RenderCommand, NamesTheBiasOfADepthCut) {
    run("render " + cornell_box + " --size 4x4 --spp 1 --termination depth:2 -o " + path("d.exr"));
    EXPECT_NE(read_exr(path("d.exr")).metadata.at("wavepath.bias").find('2'), std::string::npos);
}

TEST_F(RenderCommand, NamesTheMethodsOfMediaWhereThereAreMedia) {
    const std::string slab = WAVEPATH_SOURCE_DIR "/scenes/slab/scene.gltf";
    const std::string tiny = " --size 4x4 --spp 1 --env-radiance 1,1,1 --direction uniform";
    run("render " + slab + tiny + " -o " + path("m.exr") + " --json " + path("m.json"));
    auto settings = json("m.json")["settings"];
    settings.erase("pool");
    EXPECT_EQ(settings["distance"], "exponential");
    EXPECT_EQ(settings["direction"], "uniform");
    EXPECT_EQ(
        nlohmann::json::parse(read_exr(path("m.exr")).metadata.at("wavepath.settings")), settings);
    run("render " + cornell_box + tiny + " -o " + path("n.exr") + " --json " + path("n.json"));
    EXPECT_FALSE(json("n.json")["settings"].contains("direction"));
}

TEST_F(RenderCommand, StopsAtTheErrorAskedAndNamesItsBias) {
    const Outcome outcome =
        run("render " + cornell_box + " --size 16x16 --pool 256 --target-error 0.2 --quiet -o " +
            path("a.exr") + " --json " + path("a.json"));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.words;
    const nlohmann::json report = json("a.json");
    EXPECT_LT(report["relative_error"], 0.2);
    EXPECT_NE(report["bias"].get<std::string>().find("--target-error"), std::string::npos);
    EXPECT_EQ(
        read_exr(path("a.exr")).metadata.at("wavepath.bias"), report["bias"].get<std::string>());
}

TEST_F(RenderCommand, StopsAtTheTimeAsked) {
    const Outcome outcome =
        run("render " + cornell_box + " --size 16x16 --pool 256 --time 0.2 --quiet -o " +
            path("a.exr") + " --json " + path("a.json"));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.words;
    const nlohmann::json report = json("a.json");
    EXPECT_GE(report["times_s"]["render"], 0.2);
    EXPECT_GT(report["samples_per_pixel"], 0);
    EXPECT_EQ(report["interrupted"], false);
    EXPECT_EQ(
        read_exr(path("a.exr")).metadata.at("wavepath.samples"),
        std::to_string(report["samples_per_pixel"].get<uint64_t>()));
}

// It is said before the render, which is lost by no misspelt name of a further file.
TEST_F(RenderCommand, WritesTheOtherOutputsWhereOneCannotBe) {
    std::filesystem::create_symlink("loop.exr", path("loop.exr"));
    const std::string nowhere = path("no/such/folder.png");
    const std::pair<std::string, std::string> lost[] = {
        {"--json " + path("loop.exr"), "choose another name"},
        {"--json " + path(std::string(300, 'a')), "choose another name"},
        {"--json /dev/null", "is not the name of a regular file"},
        {"-o " + nowhere, nowhere},
    };
    const std::string render = "render " + cornell_box + " --size 4x4 --spp 1 --quiet ";
    for (const auto& [option, words] : lost) {
        const Outcome outcome = run(render + "-o " + path("a.exr") + " " + option);
        EXPECT_EQ(outcome.exit_code, 1);
        EXPECT_THAT(outcome.words, HasSubstr(words));
        EXPECT_EQ(std::ranges::count(outcome.words, '\n'), 1) << outcome.words;
        EXPECT_TRUE(std::filesystem::remove(path("a.exr"))) << option;
    }
    EXPECT_EQ(run(render + "-o " + nowhere + " --json " + path("a.json")).exit_code, 1);
    EXPECT_FALSE(std::filesystem::exists(path("a.json"))) << "no picture is left to render";
}

// PoCL's kernels are files too.
TEST_F(RenderCommand, SaysThatALimitOnFilesStopsTheKernels) {
    const std::string words = path("words");
    const std::string command = "bash -c 'ulimit -f 64; " WAVEPATH_BINARY " render " + cornell_box +
                                " --size 4x4 --spp 1 --quiet -o " + path("a.exr") + "' > " + words +
                                " 2>&1";
    EXPECT_NE(std::system(command.c_str()), 0);
    EXPECT_THAT(folder.read("words"), HasSubstr("no more than 64 KiB"));
    EXPECT_EQ(std::ranges::count(folder.read("words"), '\n'), 1);
}

TEST_F(RenderCommand, ReportsScenesWhoseNamesAreNotUtf8) {
    const std::string scene = path("caf\xe9.gltf");
    std::filesystem::copy(cornell_box, scene);
    const Outcome outcome =
        run("render " + scene + " --size 4x4 --spp 1 --quiet -o " + path("a.exr") + " --json " +
            path("a.json"));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.words;
    EXPECT_EQ(json("a.json")["scene"]["name"], path("caf\uFFFD.gltf"));
}

// However slow the machine: Ctrl-C comes later and later, until it finds a sample in every pixel.
TEST_F(RenderCommand, CtrlCWritesWhatThereIs) {
    const std::string render = " " WAVEPATH_BINARY " render " + cornell_box +
                               " --size 16x16 --time 1000 -o " + path("a.exr") + " > " +
                               path("words") + " 2>&1";
    for (int seconds = 1; seconds < 300 && !std::filesystem::exists(path("a.exr")); seconds *= 2) {
        const int status = std::system(
            fmt::format("timeout -s INT --preserve-status {}{}", seconds, render).c_str());
        ASSERT_EQ(WEXITSTATUS(status), 130) << folder.read("words");
        if (!std::filesystem::exists(path("a.exr"))) {
            ASSERT_THAT(folder.read("words"), HasSubstr("before every pixel had a sample"));
        }
    }
    const std::string words = folder.read("words");
    EXPECT_THAT(words, HasSubstr("Ctrl-C again ends at once"));
    EXPECT_THAT(
        words, HasSubstr(fmt::format(
                   "interrupted: there are {} samples a pixel",
                   read_exr(path("a.exr")).metadata.at("wavepath.samples"))));
}

TEST_F(RenderCommand, TakesTheSceneBehindItsOutputs) {
    const std::string tiny = "render --size 4x4 --spp 1 -o " + path("a.exr") + " " + path("b.png");
    EXPECT_EQ(run(tiny + " " + cornell_box).exit_code, 0);
    EXPECT_EQ(run(tiny + " -- " + cornell_box + " --quiet").exit_code, 0);
    const Outcome refused = run(tiny + " " + cornell_box + " --quiet");
    EXPECT_EQ(refused.exit_code, 1);
    EXPECT_NE(refused.words.find("a scene stands before -o or behind --"), std::string::npos)
        << refused.words;
}

TEST_F(RenderCommand, StopsAtCtrlCWithWhatThereIs) {
    const std::string picture = path("stopped.exr");
    // From its first window on it holds samples; a million would take hours.
    const Outcome outcome =
        run("render " + cornell_box + " --size 64x64 --spp 4000000 -o " + picture +
            " & pid=$!; until grep -q triangles " + path("log") +
            "; do sleep 0.1; done; sleep 1; kill -INT $pid; wait $pid");
    EXPECT_EQ(outcome.exit_code, 130);
    EXPECT_GT(std::stoull(read_exr(picture).metadata.at("wavepath.samples")), 0U);
}

}  // namespace
}  // namespace wavepath
