#include "device/timeline.h"

#include "device/profile.h"
#include "support/probe.h"

#include <gtest/gtest.h>

namespace wavepath {
namespace {

// The two clocks are brought together to half the length of a call: a launch that the host waits
// for lies between what the host saw before and after, but for that.
TEST(Timeline, PutsLaunchesWhereTheHostSawThem) {
    const Device& device = test_device();
    constexpr std::size_t bytes = std::size_t{64} << 20U;
    const cl::Buffer buffer(device.context, CL_MEM_READ_WRITE, bytes);
    Profile profile;
    profile.keep_timeline(device);
    const std::size_t row = profile.row("fill");
    const int64_t before = profile.timeline()->now();
    cl::Event event;
    device.queue.enqueueFillBuffer(buffer, cl_uint{1}, 0, bytes, nullptr, &event);
    profile.add(row, 7, event);
    device.queue.finish();
    const int64_t after = profile.timeline()->now();
    profile.collect();
    if (!profile.device_clock()) GTEST_SKIP() << "this driver returns no times";
    ASSERT_EQ(profile.timeline()->launches().size(), 1U);
    const Timeline::Launch& launch = profile.timeline()->launches().front();
    EXPECT_EQ(launch.items, 7U);
    EXPECT_LT(launch.start, launch.end);
    // Another process may come between the two looks at the clocks, for a time slice.
    constexpr int64_t slack = 20'000'000;
    EXPECT_GT(launch.start, before - slack);
    EXPECT_LT(launch.end, after + slack);
}

TEST(Timeline, KeepsNoLaunchUnlessAsked) {
    const Device& device = test_device();
    const cl::Buffer buffer(device.context, CL_MEM_READ_WRITE, 4);
    Profile profile;
    EXPECT_EQ(profile.timeline(), nullptr);
    cl::Event event;
    device.queue.enqueueFillBuffer(buffer, cl_uint{0}, 0, 4, nullptr, &event);
    profile.add(profile.row("fill"), 1, event);
    device.queue.finish();
    profile.collect();
    EXPECT_FALSE(profile.take_timeline().has_value());
}

TEST(HostSpan, IsAddedWhereItsScopeEnds) {
    Timeline timeline(test_device());
    {
        const HostSpan span(&timeline, "work");
        EXPECT_TRUE(timeline.spans().empty());
    }
    ASSERT_EQ(timeline.spans().size(), 1U);
    EXPECT_EQ(timeline.spans().front().name, "work");
    EXPECT_LE(timeline.spans().front().start, timeline.spans().front().end);
    const HostSpan nowhere(nullptr, "unseen");
}

}  // namespace
}  // namespace wavepath
