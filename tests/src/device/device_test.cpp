#include "device/device.h"

#include "device/selection.h"
#include "error.h"
#include "support/environment_variable.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <unistd.h>

#include <cstdlib>
#include <thread>

namespace wavepath {
namespace {

TEST(Device, DefaultIsPoclOnTheCpuAndUsable) {
    const Device device = open_device("");
    EXPECT_TRUE(is_pocl(device.info)) << "these tests need PoCL";
    EXPECT_TRUE(device.info.is_cpu);
    EXPECT_EQ(device.info.unusable, "");
    EXPECT_GT(device.info.compute_units, 0U);
    EXPECT_GT(device.info.max_allocation, 0U);
    EXPECT_EQ(
        device.queue.getInfo<CL_QUEUE_PROPERTIES>(),
        cl_command_queue_properties{CL_QUEUE_PROFILING_ENABLE});
}

// PoCL builds a kernel a second time for grids of 65535 and more; a pool fills whole work-groups.
TEST(Device, PoolOfACpuStaysBelowPoclsSecondBuild) {
    const Device device = open_device("");
    EXPECT_LT(device.info.default_pool, 65535U);
    EXPECT_EQ(device.info.default_pool % 256, 0U);
}

TEST(Device, OpeningTheDefaultLeavesTheEnvironmentAsItWas) {
    const EnvironmentVariable vendors("OCL_ICD_VENDORS");
    const EnvironmentVariable names("OCL_ICD_FILENAMES");
    open_device("");
    EXPECT_EQ(std::getenv("OCL_ICD_VENDORS"), nullptr);
    EXPECT_EQ(std::getenv("OCL_ICD_FILENAMES"), nullptr);
}

TEST(Device, UnknownSelectorThrowsWithTheList) {
    try {
        open_device("no such device");
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("Portable Computing Language"));
    }
}

TEST(PrepareEnvironment, KeepsTheUsersAffinity) {
    const EnvironmentVariable affinity("POCL_AFFINITY", "0");
    prepare_environment();
    EXPECT_STREQ(std::getenv("POCL_AFFINITY"), "0");
}

TEST(PrepareEnvironment, PinsOnlyWhereEveryCpuMayBeUsed) {
    const EnvironmentVariable affinity("POCL_AFFINITY");
    cpu_set_t before;
    ASSERT_EQ(sched_getaffinity(0, sizeof(before), &before), 0);
    if (CPU_COUNT(&before) != sysconf(_SC_NPROCESSORS_ONLN) || CPU_COUNT(&before) < 2)
        GTEST_SKIP() << "the process may not use every CPU, or there is but one";
    prepare_environment();
    EXPECT_STREQ(std::getenv("POCL_AFFINITY"), "1");

    unsetenv("POCL_AFFINITY");
    std::thread([] {  // an affinity is a thread's: the other threads keep theirs
        cpu_set_t one;
        CPU_ZERO(&one);
        CPU_SET(0, &one);
        sched_setaffinity(0, sizeof(one), &one);
        prepare_environment();
    })
        .join();
    EXPECT_EQ(std::getenv("POCL_AFFINITY"), nullptr);
}

}  // namespace
}  // namespace wavepath
