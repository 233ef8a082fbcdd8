#include "commands/interrupt.h"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <thread>

namespace wavepath {
namespace {

// As from `timeout -s INT`, which signals the process and then its group.
TEST(Interrupt, TwiceAtOnceIsOnce) {
    EXPECT_EXIT(
        {
            const InterruptGuard interrupt;
            std::raise(SIGINT);
            std::raise(SIGINT);
            std::_Exit(interrupt.requested() ? 0 : 1);
        },
        testing::ExitedWithCode(0), "Ctrl-C again ends at once");
}

TEST(Interrupt, TheSecondOneEndsTheProgram) {
    EXPECT_EXIT(
        {
            const InterruptGuard interrupt;
            std::raise(SIGINT);
            std::this_thread::sleep_for(std::chrono::milliseconds(400));
            std::raise(SIGINT);
            std::_Exit(0);
        },
        testing::KilledBySignal(SIGINT), "Ctrl-C again ends at once");
}

}  // namespace
}  // namespace wavepath
