#include "device/profile.h"

#include "support/probe.h"

#include <gtest/gtest.h>

namespace wavepath {
namespace {

// Events take memory, and a window has any number of launches.
TEST(Profile, HoldsABoundedNumberOfEvents) {
    const Device& device = test_device();
    const cl::Buffer buffer(device.context, CL_MEM_READ_WRITE, 4);
    Profile profile;
    const std::size_t row = profile.row("fill");
    constexpr uint64_t launches = 2 * Profile::most_pending + 3;
    for (uint64_t i = 0; i < launches; ++i) {
        cl::Event event;
        device.queue.enqueueFillBuffer(buffer, cl_uint{0}, 0, 4, nullptr, &event);
        profile.add(row, 1, event);
        ASSERT_LE(profile.pending(), Profile::most_pending);
    }
    EXPECT_LT(profile.pending(), 4U);
    device.queue.finish();
    profile.collect();
    EXPECT_EQ(profile.pending(), 0U);
    EXPECT_EQ(profile.rows().front().launches, launches);
    EXPECT_EQ(profile.rows().front().items, launches);
}

}  // namespace
}  // namespace wavepath
