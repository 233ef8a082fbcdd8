#include "device/selection.h"

#include "error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace wavepath {
namespace {

using testing::HasSubstr;

DeviceInfo device(uint32_t p, uint32_t d, const std::string& platform, const std::string& name) {
    DeviceInfo info;
    info.platform_index = p;
    info.device_index = d;
    info.platform = platform;
    info.name = name;
    info.is_cpu = name.find("CPU") != std::string::npos;
    info.is_gpu = name.find("GPU") != std::string::npos;
    return info;
}

DeviceInfo unusable(DeviceInfo info, const std::string& why) {
    info.unusable = why;
    return info;
}

std::vector<DeviceInfo> machine() {
    return {
        device(0, 0, "Vendor OpenCL", "Fast GPU 3.1"),
        device(0, 1, "Vendor OpenCL", "Vendor CPU"),
        unusable(device(1, 0, "Old", "Old GPU"), "OpenCL 1.2 is needed"),
        device(2, 0, "Portable Computing Language", "pthread CPU"),
    };
}

std::string message(const std::vector<DeviceInfo>& devices, const std::string& selector) {
    try {
        select_device(devices, selector);
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

TEST(Selection, DefaultIsTheCpuOfPocl) {
    EXPECT_EQ(select_device(machine(), ""), 3U);
}

TEST(Selection, DefaultWithoutPoclIsTheFirstUsable) {
    const std::vector<DeviceInfo> devices = {machine()[2], machine()[1]};
    EXPECT_EQ(select_device(devices, ""), 1U);
}

TEST(Selection, KindIndexAndPartOfNameInAnyCase) {
    EXPECT_EQ(select_device(machine(), "cpu"), 1U);
    EXPECT_EQ(select_device(machine(), "GPU"), 0U);
    EXPECT_EQ(select_device(machine(), "2.0"), 3U);
    EXPECT_EQ(select_device(machine(), "portable"), 3U);
    EXPECT_EQ(select_device(machine(), "Portable Computing"), 3U);
    EXPECT_EQ(select_device(machine(), "PoCL"), 3U);
    EXPECT_EQ(select_device(machine(), "FAST"), 0U);
    EXPECT_EQ(select_device(machine(), "vendor cpu"), 1U);
}

TEST(Selection, AnIndexIsNoPartOfAName) {
    EXPECT_THAT(message(machine(), "3.1"), HasSubstr("--device 3.1: no such device"));
}

TEST(Selection, ErrorsListWhatThereIs) {
    EXPECT_THAT(message(machine(), "nothing"), HasSubstr("0.1 Vendor OpenCL, Vendor CPU"));
    EXPECT_THAT(
        message(machine(), "nothing"), HasSubstr("1.0 Old, Old GPU (not usable: OpenCL 1.2"));
    EXPECT_THAT(message(machine(), "old"), HasSubstr("cannot be used: OpenCL 1.2 is needed"));
    EXPECT_THAT(message({}, ""), HasSubstr("pocl-opencl-icd"));
}

}  // namespace
}  // namespace wavepath
