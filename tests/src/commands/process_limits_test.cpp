// Runs under limits and in odd environments: the same bytes, or one line that says why not.
#include "support/case_files.h"
#include "support/command.h"

#include <gmock/gmock.h>

#include <map>
#include <sstream>

namespace wavepath {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class ProcessLimits : public CommandTest {
  protected:
    // What the script says of each run: "rc=0 picture=same :: message|", by the run's name.
    std::map<std::string, std::string> lines() const {
        const std::string script = (case_folder("process-limits") / "run.sh").string();
        const std::string output = path("output");
        EXPECT_EQ(
            std::system(("TMPDIR='" + folder.path().string() +
                         "' WAVEPATH='" WAVEPATH_BINARY "' bash '" + script + "' > '" + output +
                         "' 2> /dev/null")
                            .c_str()),
            0);
        std::map<std::string, std::string> found;
        std::istringstream text(folder.read("output"));
        for (std::string line; std::getline(text, line);)
            found[line.substr(0, line.find(' '))] = line.substr(line.find(' ') + 1);
        return found;
    }
};

// POCL_MAX_PTHREAD_COUNT above the number of CPUs aborted once: exit status 134.
TEST_F(ProcessLimits, ChangeNoBytesOrAreSaidInALine) {
    if (case_folder("process-limits").empty())
        GTEST_SKIP() << "no folder of cases beside the checkout";
    const auto found = lines();
    ASSERT_EQ(found.at("ref"), "rc=0");
    for (const char* same :
         {"stack_unlimited", "stack_1M", "stack_256k", "stdin_closed", "all_closed",
          "all_closed_loud", "stderr_closed", "stderr_full", "no_home", "bad_home", "tmpdir",
          "threads64", "threads0", "nocache", "path"})
        EXPECT_THAT(found.at(same), StartsWith("rc=0 picture=same ::")) << same;
    EXPECT_EQ(found.at("json"), "ok");
    for (const char* refused : {"memory_400M", "nonsense", "devnull", "stdout", "jsonstdout"})
        EXPECT_THAT(found.at(refused), StartsWith("rc=1 picture=- :: error: ")) << refused;
    EXPECT_THAT(found.at("fifo"), HasSubstr("is not the name of a regular file"));
    for (const auto& [name, line] : found) {
        if (name == "ref" || name == "json") continue;
        EXPECT_THAT(line, testing::AnyOf(StartsWith("rc=0 picture=same"), StartsWith("rc=1 ")))
            << name;
        EXPECT_LE(std::ranges::count(line, '|'), 1) << name << ": " << line;
    }
    EXPECT_GE(found.size(), 33U);
}

}  // namespace
}  // namespace wavepath
