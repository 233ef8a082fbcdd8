// No signal and no closed stream loses a picture.
#include "image/exr_writer.h"
#include "support/command.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <csignal>

namespace wavepath {
namespace {

using testing::HasSubstr;

class Signals : public CommandTest {
  protected:
    // The exit status of an endless render that is sent `signal` after `seconds`.
    int interrupt(const char* signal, int seconds) const {
        return run(fmt::format(
                       "render {} --size 16x16 --time 1000 --quiet -o {}", cornell_box,
                       path("a.exr")),
                   fmt::format("timeout -s {} --preserve-status {}", signal, seconds))
            .exit_code;
    }
};

// However slow the machine: they come later and later, until they find a sample in every pixel.
TEST_F(Signals, WriteWhatThereIs) {
    int seconds = 1;
    for (const auto& [name, number] :
         {std::pair{"TERM", SIGTERM},
          {"HUP", SIGHUP},
          {"XCPU", SIGXCPU},
          {"PIPE", SIGPIPE},
          {"XFSZ", SIGXFSZ}}) {
        SCOPED_TRACE(name);
        std::filesystem::remove(path("a.exr"));
        while (true) {
            ASSERT_EQ(interrupt(name, seconds), 128 + number) << folder.read("log");
            if (std::filesystem::exists(path("a.exr")) || seconds > 300) break;
            ASSERT_THAT(folder.read("log"), HasSubstr("before every pixel had a sample"));
            seconds *= 2;
        }
        EXPECT_THAT(
            folder.read("log"), HasSubstr(fmt::format(
                                    "interrupted: there are {} samples a pixel",
                                    read_exr(path("a.exr")).metadata.at("wavepath.samples"))));
    }
}

TEST_F(Signals, StreamsThatTakeNothingAreNoReasonToStop) {
    const std::string tiny = "render " + cornell_box + " --size 4x4 --spp 1 -o " + path("a.exr");
    for (const char* streams :
         {"2> /dev/full", "2>&-", "<&- >&- 2>&-", "2>&1 | true; exit ${PIPESTATUS[0]}"}) {
        SCOPED_TRACE(streams);
        std::filesystem::remove(path("a.exr"));
        const int status =
            std::system(fmt::format("bash -c '" WAVEPATH_BINARY " {} {}'", tiny, streams).c_str());
        EXPECT_EQ(WEXITSTATUS(status), 0);
        EXPECT_EQ(read_exr(path("a.exr")).metadata.at("wavepath.samples"), "1");
    }
}

// The table is the result there, but the pictures come first.
TEST_F(Signals, OutputThatIsNotWholeIsAnErrorBehindTheReport) {
    const std::string tiny =
        "profile " + cornell_box + " --size 4x4 --spp 1 --json " + path("a.json");
    const int status =
        std::system((WAVEPATH_BINARY " " + tiny + " > /dev/full 2> " + path("log")).c_str());
    EXPECT_EQ(WEXITSTATUS(status), 1);
    EXPECT_THAT(folder.read("log"), HasSubstr("standard output: cannot be written"));
    EXPECT_EQ(json("a.json")["samples_per_pixel"], 1);
}

TEST_F(Signals, NohupIsHeeded) {
    const std::string log = path("log");
    const int status = std::system(
        fmt::format(
            "trap '' HUP; " WAVEPATH_BINARY
            " render {} --size 16x16 --time 1 -o {} > {} 2>&1 & pid=$!;"
            " until grep -q triangles {}; do sleep 0.1; done; kill -HUP $pid; wait $pid",
            cornell_box, path("a.exr"), log, log)
            .c_str());
    EXPECT_EQ(WEXITSTATUS(status), 0) << folder.read("log");
}

}  // namespace
}  // namespace wavepath
