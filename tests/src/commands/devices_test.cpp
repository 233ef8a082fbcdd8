#include "support/command.h"

#include <algorithm>

namespace wavepath {
namespace {

using DevicesCommand = CommandTest;

TEST_F(DevicesCommand, NamesOneDefaultThatRenderTakes) {
    ASSERT_EQ(run("devices --json").exit_code, 0);
    const nlohmann::json list = json("log");
    EXPECT_EQ(list["schema_version"], 1);
    const auto& devices = list["devices"];
    const auto chosen = std::ranges::find_if(
        devices, [](const nlohmann::json& device) { return device["default"].get<bool>(); });
    ASSERT_NE(chosen, devices.end());
    EXPECT_EQ(
        std::ranges::count_if(
            devices, [](const auto& d) { return d["default"].template get<bool>(); }),
        1);
    EXPECT_TRUE((*chosen)["usable"].get<bool>());
    EXPECT_GT((*chosen)["default_pool"], 0);

    const std::string selector = std::to_string((*chosen)["platform_index"].get<int>()) + "." +
                                 std::to_string((*chosen)["device_index"].get<int>());
    const std::string arguments = "render " + cornell_box + " --size 4x4 --spp 1 --quiet ";
    ASSERT_EQ(
        run(arguments + "-o " + path("a.exr") + " --json " + path("a.json") + " --device " +
            selector)
            .exit_code,
        0);
    EXPECT_EQ(json("a.json")["device"]["name"], (*chosen)["name"]);
    ASSERT_EQ(run(arguments + "-o " + path("b.exr")).exit_code, 0);
    EXPECT_EQ(folder.read("a.exr"), folder.read("b.exr"));
}

TEST_F(DevicesCommand, ListsTheSameAsText) {
    ASSERT_EQ(run("devices --json").exit_code, 0);
    const nlohmann::json list = json("log");
    const std::string words = run("devices").words;
    for (const nlohmann::json& device : list["devices"])
        EXPECT_NE(words.find(device["platform"].get<std::string>()), std::string::npos) << words;
    EXPECT_NE(words.find("(default)"), std::string::npos) << words;
}

TEST_F(DevicesCommand, SaysWhatToInstallWhereThereIsNoDriver) {
    const std::string nowhere = "OCL_ICD_VENDORS=" + path("nowhere");
    const Outcome none = run("devices", nowhere);
    EXPECT_EQ(none.exit_code, 0);
    EXPECT_NE(none.words.find("pocl-opencl-icd"), std::string::npos) << none.words;
    const Outcome render = run("render " + cornell_box + " -o " + path("a.exr"), nowhere);
    EXPECT_EQ(render.exit_code, 1);
    EXPECT_NE(render.words.find("no OpenCL device"), std::string::npos) << render.words;
}

}  // namespace
}  // namespace wavepath
