// Files of one picture are the same bytes, whatever made them.
#include "support/command.h"

#include <gmock/gmock.h>

namespace wavepath {
namespace {

using FileBytes = CommandTest;

TEST_F(FileBytes, DoNotDependOnThePool) {
    for (const char* pool : {"100", "3000"}) {
        const std::string name = path(pool);
        const Outcome outcome =
            run("render " + cornell_box + " --size 16x12 --spp 5 --pool " + pool + " -o " + name +
                ".exr " + name + ".png --json " + name + ".json");
        ASSERT_EQ(outcome.exit_code, 0) << outcome.words;
        EXPECT_EQ(json(std::string(pool) + ".json")["settings"]["pool"], std::stoi(pool));
    }
    EXPECT_EQ(folder.read("100.exr"), folder.read("3000.exr"));
    EXPECT_EQ(folder.read("100.png"), folder.read("3000.png"));
    EXPECT_THAT(folder.read("100.exr"), testing::HasSubstr("wavepath.settings"));
}

}  // namespace
}  // namespace wavepath
