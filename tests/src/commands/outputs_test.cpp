#include "commands/outputs.h"

#include "commands/interrupt.h"
#include "commands/progress.h"
#include "image/exr_writer.h"
#include "support/temporary_folder.h"

#include <gmock/gmock.h>

#include <cstdio>

namespace wavepath {
namespace {

RenderResult grey_picture() {
    RenderResult result;
    result.samples = 1;
    Image& image = result.film.image;
    image.width = image.height = 2;
    for (const char* name : {"R", "G", "B"}) image.channels[name].assign(4, 0.5F);
    return result;
}

TEST(Outputs, WhatCanBeWrittenIsWrittenAndTheRestIsSaidInALineEach) {
    const TemporaryFolder folder;
    const Device device;
    const RenderJob job;
    RenderResult result = grey_picture();
    Outputs outputs;
    outputs.images = {
        folder / "gone/a.exr", folder / "b.exr", folder / "gone/c.png", folder / "d.png"};
    outputs.json = folder / "e.json";
    testing::internal::CaptureStdout();  // the logger of tests
    EXPECT_THROW(write_outputs(device, job, result, outputs, {}), OutputFailed);
    const std::string words = testing::internal::GetCapturedStdout();
    for (const char* name : {"b.exr", "d.png", "e.json"})
        EXPECT_TRUE(std::filesystem::exists(folder / name)) << name;
    for (const char* name : {"gone/a.exr", "gone/c.png"})
        EXPECT_THAT(
            words, testing::ContainsRegex(
                       "error.*" + (folder / name).string() + ": cannot be written: .*\n"));
    EXPECT_EQ(read_exr(folder / "b.exr").channels.at("R"), std::vector<float>(4, 0.5F));
}

TEST(Outputs, OfAnInterruptedRenderAreWrittenFirst) {
    const TemporaryFolder folder;
    const Device device;
    const RenderJob job;
    RenderResult result = grey_picture();
    result.interrupted = true;
    Outputs outputs;
    outputs.images = {folder / "a.png"};
    EXPECT_THROW(write_outputs(device, job, result, outputs, {}), Interrupted);
    EXPECT_TRUE(std::filesystem::exists(folder / "a.png"));
    outputs.images = {folder / "gone/a.png"};
    EXPECT_THROW(write_outputs(device, job, result, outputs, {}), OutputFailed);
}

TEST(Progress, GoesOnWhereNobodyListens) {
    EXPECT_EXIT(
        {
            if (std::freopen("/dev/full", "w", stderr) == nullptr) std::_Exit(1);
            const RenderSettings settings;
            Progress progress(settings, false);
            progress.show({1, 64, 20, 1, [] { return 0.5; }});
            std::_Exit(0);
        },
        testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace wavepath
