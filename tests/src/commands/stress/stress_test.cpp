#include "commands/stress/stress.h"

#include "support/command.h"

#include <gmock/gmock.h>

#include <algorithm>

namespace wavepath {
namespace {

using testing::HasSubstr;

class StressCommand : public CommandTest {};

TEST_F(StressCommand, WritesAPageAndItsNumbers) {
    const Outcome outcome = run("stress --quick --methods film,direct -o " + path("stress"));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.words;
    const auto report = json("stress/stress.json");
    EXPECT_EQ(report["schema"], "wavepath stress");
    std::size_t noisy = 0;
    std::size_t infinite = 0;
    for (const auto& cell : report["cells"]) {
        EXPECT_EQ(cell["verdict"], cell["expected"]) << cell;
        noisy += cell["verdict"] == "noisy" ? 1 : 0;
        infinite += cell["verdict"] == "infinite variance" ? 1 : 0;
    }
    EXPECT_EQ(noisy, 2U);     // a hundredth and a thousandth below a light
    EXPECT_EQ(infinite, 1U);  // the wall that a light touches
    const std::string page = folder.read("stress/index.html");
    EXPECT_THAT(page, HasSubstr("A wall that a light touches"));
    EXPECT_THAT(page, HasSubstr("0 verdicts differ"));
}

TEST_F(StressCommand, NamesTheMethodsThereAre) {
    const Outcome outcome = run("stress --quick --methods best -o " + path("stress"));
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(outcome.words, HasSubstr("--methods best: no column; use some of"));
    EXPECT_EQ(std::ranges::count(outcome.words, '\n'), 1);
    EXPECT_EQ(folder.file_count(), 1U);  // the log
}

}  // namespace
}  // namespace wavepath
