#include "device/device_probe.h"
#include "build_paths.h"

#include "device/selection.h"
#include "support/environment_variable.h"
#include "support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

namespace wavepath {
namespace {

using testing::HasSubstr;

// Drivers for one test: PoCL and one that fails as `failure` says
// (tests/drivers/broken_driver.cpp).
class Drivers {
  public:
    explicit Drivers(const std::string& failure) : failure_("BROKEN_DRIVER", failure) {
        std::filesystem::copy(pocl_icd, folder_.path());
        folder_.write("broken.icd", WAVEPATH_BROKEN_DRIVER "\n");
    }
    static bool have_pocl() { return std::filesystem::exists(pocl_icd); }

  private:
    static constexpr const char* pocl_icd = "/etc/OpenCL/vendors/pocl.icd";
    TemporaryFolder folder_;
    EnvironmentVariable vendors_{"OCL_ICD_VENDORS", folder_.path().string()};
    EnvironmentVariable failure_;
};

const DeviceInfo* row_of(const std::vector<DeviceInfo>& rows, const std::string& platform) {
    const auto row = std::find_if(rows.begin(), rows.end(), [&](const DeviceInfo& info) {
        return info.platform == platform;
    });
    return row == rows.end() ? nullptr : &*row;
}

class ListDevices : public testing::Test {
  protected:
    void SetUp() override {
        if (!Drivers::have_pocl()) GTEST_SKIP() << "PoCL is not installed in the usual place";
    }

    void list(const std::string& failure) {
        const Drivers drivers(failure);
        rows = list_devices(std::chrono::seconds(60));
        pocl = row_of(rows, "Portable Computing Language");
        ASSERT_NE(pocl, nullptr);
    }

    std::vector<DeviceInfo> rows;
    const DeviceInfo* pocl = nullptr;
};

TEST_F(ListDevices, ADriverThatReportsErrorsIsARow) {
    list("error");
    EXPECT_EQ(pocl->unusable, "");
    EXPECT_GT(pocl->default_pool, 0U);
    EXPECT_EQ(rows.size(), 2U);
    const auto broken = std::find_if(
        rows.begin(), rows.end(), [](const DeviceInfo& info) { return !info.unusable.empty(); });
    ASSERT_NE(broken, rows.end());
    EXPECT_THAT(broken->unusable, HasSubstr("clGetDeviceInfo, OpenCL error -33"));
}

TEST_F(ListDevices, ADriverThatCrashesWhenAskedIsARow) {
    list("crash when asked");
    EXPECT_EQ(pocl->unusable, "");
    ASSERT_NE(row_of(rows, "broken"), nullptr);
    EXPECT_THAT(row_of(rows, "broken")->unusable, HasSubstr("crashes (signal 6)"));
}

// Says nothing of PoCL: whether it answers in time is the machine's business.
TEST_F(ListDevices, ADriverThatHangsWhenAskedIsARow) {
    const Drivers drivers("hang when asked");
    const std::vector<DeviceInfo> rows = list_devices(std::chrono::seconds(5));
    EXPECT_TRUE(std::any_of(rows.begin(), rows.end(), [](const DeviceInfo& row) {
        return row.unusable.find("does not answer within 5 s") != std::string::npos;
    }));
}

// Then the drivers are looked at one by one, and the message says how to leave the broken one out.
TEST_F(ListDevices, ADriverThatCrashesOnLoadIsNamed) {
    list("crash on load");
    EXPECT_THAT(pocl->unusable, HasSubstr("OCL_ICD_VENDORS="));
    EXPECT_THAT(pocl->unusable, HasSubstr("pocl.icd"));
    ASSERT_NE(row_of(rows, "broken.icd"), nullptr);
    EXPECT_THAT(
        row_of(rows, "broken.icd")->unusable, HasSubstr("crashes (signal 6) as it is loaded"));
}

TEST(ListNoDevices, WithoutADriverTheListIsEmpty) {
    const TemporaryFolder none;
    const EnvironmentVariable vendors("OCL_ICD_VENDORS", none.path().string());
    EXPECT_TRUE(list_devices().empty());
}

TEST(RunDeviceProbe, LeavesOtherCommandLinesAlone) {
    std::string program = "wavepath", command = "devices";
    char* arguments[] = {program.data(), command.data(), nullptr};
    EXPECT_FALSE(run_device_probe(2, arguments));
}

}  // namespace
}  // namespace wavepath
