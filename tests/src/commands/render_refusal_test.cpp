// What `render` refuses: one line for what is wrong, and no picture.
#include "support/render_command.h"

#include <gmock/gmock.h>

#include <fstream>

namespace wavepath {
namespace {

using testing::HasSubstr;

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
            "error: rendr is no command: render, devices, profile, chart, diff, stress; see "
            "wavepath --help\n");
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

}  // namespace
}  // namespace wavepath
