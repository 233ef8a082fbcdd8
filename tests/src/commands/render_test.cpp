// The program as a user meets it: exit codes, one line for what is wrong, nothing half-written.
#include "build_paths.h"
#include "image/exr_writer.h"
#include "support/command.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

namespace wavepath {
namespace {

using testing::HasSubstr;

class RenderCommand : public CommandTest {
  protected:
    // It fails with one line that holds `words`, and leaves no picture.
    void expect_refused(const std::string& arguments, const std::string& words) const {
        SCOPED_TRACE(arguments);
        const std::string picture = path("refused.exr");
        const Outcome outcome = run("render " + arguments + " --quiet -o " + picture);
        EXPECT_EQ(outcome.exit_code, 1);
        EXPECT_NE(outcome.words.find(words), std::string::npos) << outcome.words;
        EXPECT_EQ(std::ranges::count(outcome.words, '\n'), 1) << outcome.words;
        EXPECT_FALSE(std::filesystem::exists(picture));
    }
};

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

TEST_F(RenderCommand, RefusesWithOneLine) {
    expect_refused(path("nothing.gltf"), "nothing.gltf");
    expect_refused(cornell_box + " --size 0x8", "--size 0x8");
    expect_refused(cornell_box + " --size 8", "--size 8");
    expect_refused(cornell_box + " --spp 0", "4294967295");
    expect_refused(cornell_box + " --spp -3", "Value -3");
    expect_refused(cornell_box + " --seed -1", "4294967295");
    expect_refused(cornell_box + " --spp 4 --time 1", "give one of them");
    expect_refused(cornell_box + " --exposure nan", "--exposure nan");
    expect_refused(cornell_box + " --exposure abc", "--exposure abc: use stops");
    expect_refused(cornell_box + " --fov abc", "--fov = abc: not a number");
    expect_refused(cornell_box + " --env-radiance 1e39,1,1", "--env-radiance 1e39,1,1");
    expect_refused(cornell_box + " --json a.exr -o ./a.exr", "are one file");
    expect_refused(cornell_box + " --json " + cornell_box, "are one file");
    expect_refused(cornell_box + " --env a.exr -o a.exr", "are one file");
    expect_refused(cornell_box + " --target-error -1", "--target-error");
    expect_refused(cornell_box + " --method photon", "--method");
    expect_refused(cornell_box + " --termination depth:x", "--termination depth:x");
    expect_refused(cornell_box + " --splits 2", "--splits 2");
    expect_refused(cornell_box + " --splits 2,0", "--splits 2,0");
    expect_refused(
        cornell_box + " --splits 1,1,2 --split-depth 0",
        "--splits with --split-depth 0: nothing would branch; take 1 or more");
    expect_refused(
        cornell_box + " --splits 1,1,64 --split-depth 8",
        "--splits 1,1,64 --split-depth 8: up to 3e+14 paths a sample, at most 1e+08; lower them");
    expect_refused(cornell_box + " --camera nobody", "--camera nobody");
    expect_refused(cornell_box + " --scene nobody", "--scene nobody");
    expect_refused(cornell_box + " --look-at 0,0,0,0,0,0", "--look-at");
    expect_refused(cornell_box + " --env-radiance 1,2", "--env-radiance 1,2");
    expect_refused(cornell_box + " --env " + path("no.hdr"), "no.hdr");
    expect_refused(cornell_box + " --no-such-option", "--no-such-option");
}

TEST_F(RenderCommand, NamesWhatIsNoCommand) {
    for (const char* rest : {"", " scene.gltf", " scene.gltf -o a.exr"}) {
        const Outcome outcome = run(std::string("rendr") + rest);
        EXPECT_EQ(outcome.exit_code, 1);
        EXPECT_EQ(
            outcome.words,
            "error: rendr is no command: render, profile, diff, stress or devices; see wavepath "
            "--help\n");
    }
}

TEST_F(RenderCommand, RefusesOutputsThatAreOneFileHoweverTheyAreLinked) {
    std::ofstream(path("a.exr")) << "a file";
    std::filesystem::create_hard_link(path("a.exr"), path("hard.exr"));
    std::filesystem::create_symlink("a.exr", path("soft.exr"));
    std::filesystem::create_symlink("loop.exr", path("loop.exr"));
    for (const char* name : {"hard.exr", "soft.exr"})
        expect_refused(
            cornell_box + " -o " + path("a.exr") + " --json " + path(name), "are one file");
    EXPECT_EQ(std::filesystem::file_size(path("a.exr")), 6U);
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

TEST_F(RenderCommand, RefusesOutputsItCannotWriteBeforeRendering) {
    const Outcome folder_missing = run("render " + cornell_box + " -o " + path("no/where.exr"));
    EXPECT_EQ(folder_missing.exit_code, 1);
    EXPECT_NE(folder_missing.words.find("where.exr"), std::string::npos) << folder_missing.words;
    const Outcome kind = run("render " + cornell_box + " -o " + path("a.jpg"));
    EXPECT_EQ(kind.exit_code, 1);
    EXPECT_NE(kind.words.find(".exr or .png"), std::string::npos) << kind.words;
}

// PoCL can be told to have 1 GiB, a quarter of it in one buffer.
TEST_F(RenderCommand, RefusesMoreMemoryThanTheDeviceHas) {
    const auto refusal = [&](const std::string& size) {
        const Outcome outcome =
            run("render " + cornell_box + " --device cpu --quiet -o " + path("a.exr") + size,
                "POCL_MEMORY_LIMIT=1");
        EXPECT_EQ(outcome.exit_code, 1) << outcome.words;
        EXPECT_FALSE(std::filesystem::exists(path("a.exr")));
        return outcome.words;
    };
    EXPECT_THAT(
        refusal(" --size 4000x4000"), HasSubstr("of which 2198 for the film, 144 bytes a pixel"));
    EXPECT_THAT(
        refusal(" --size 1300x1300 --pool 16000000"),
        HasSubstr("needed in one buffer, the device allows 256 MiB"));
}

TEST_F(RenderCommand, RefusesToReplaceWhatTheSceneIsMadeOf) {
    std::ofstream(path("body.png")) << "a picture";
    std::ofstream(path("scene.gltf"))
        << R"({"asset":{"version":"2.0"},"images":[{"uri":"body.png"}],"buffers":[{"byteLength":36,)"
           R"("uri":"data:application/octet-stream;base64,)" +
               std::string(48, 'A') +
               R"("}],"bufferViews":[{"buffer":0,"byteLength":36}],"accessors":[{"bufferView":0,)"
               R"("componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[0,0,0]}],)"
               R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":[{"mesh":0}],)"
               R"("scenes":[{"nodes":[0]}]})";
    const Outcome outcome =
        run("render " + path("scene.gltf") + " --look-at 0,0,1,0,0,0 -o " + path("body.png"));
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(outcome.words, HasSubstr("body.png are one file"));
    EXPECT_EQ(std::filesystem::file_size(path("body.png")), 9U);
}

TEST_F(RenderCommand, RefusesAFolderWithoutKernels) {
    const std::string arguments =
        "render " + cornell_box + " --size 4x4 --spp 1 -o " + path("a.exr");
    const Outcome outcome = run(arguments, "WAVEPATH_KERNELS=" + folder.path().string());
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_NE(outcome.words.find("unset WAVEPATH_KERNELS"), std::string::npos) << outcome.words;
    EXPECT_EQ(run(arguments, "WAVEPATH_KERNELS=").exit_code, 0);
}

TEST_F(RenderCommand, RefusesASceneWithoutLight) {
    const auto scene =
        folder.write("dark.gltf", R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],
        "nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],
        "bufferViews":[{"buffer":0,"byteLength":36}],
        "buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})");
    expect_refused(scene.string(), "no light");
    EXPECT_EQ(
        run("render " + scene.string() + " --env-radiance 1,1,1 --size 4x4 --spp 1 -o " +
            path("lit.exr"))
            .exit_code,
        0);
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
