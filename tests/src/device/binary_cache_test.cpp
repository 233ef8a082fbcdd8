#include "device/binary_cache.h"

#include "device/program.h"
#include "error.h"
#include "support/environment_variable.h"
#include "support/temporary_folder.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

namespace wavepath {
namespace {

constexpr const char* source = "kernel void answer(global int* x) { *x = 42; }\n";

// PoCL is not cached by wavepath: under another name it is, which tries the cache where there is
// but one driver.
std::optional<Device> open(const std::string& driver) {
    if (driver == "pocl") {
        Device device = open_device("");
        device.info.platform = "any other platform";
        return device;
    }
    try {
        return open_device(driver);
    } catch (const Error&) {
        return std::nullopt;
    }
}

int answer(const Device& device, const cl::Program& program) {
    cl::Kernel kernel(program, "answer");
    const cl::Buffer buffer(device.context, CL_MEM_READ_WRITE, sizeof(int));
    kernel.setArg(0, buffer);
    device.queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(1), cl::NDRange(1));
    int value = 0;
    device.queue.enqueueReadBuffer(buffer, CL_TRUE, 0, sizeof(value), &value);
    return value;
}

std::filesystem::path only_entry_of(const TemporaryFolder& folder) {
    const auto entries = std::filesystem::directory_iterator(folder / "wavepath");
    EXPECT_EQ(std::distance(begin(entries), end(entries)), 1);
    return std::filesystem::directory_iterator(folder / "wavepath")->path();
}

class BinaryCacheOn : public testing::TestWithParam<const char*> {
  protected:
    void SetUp() override {
        device = open(GetParam());  // before XDG_CACHE_HOME changes: PoCL looks at it once
        cache_home.emplace("XDG_CACHE_HOME", folder.path().string());
        if (!device)
            GTEST_SKIP()
                << GetParam()
                << " is not there: not installed, or other drivers were loaded before; ctest "
                   "runs each test in a process of its own";
    }

    // Builds, checks that the program works, and tells whether it came from the cache.
    bool built_from_cache() {
        BuildReport report;
        const cl::Program program = build_program(*device, source, &report);
        EXPECT_EQ(answer(*device, program), 42);
        return report.from_cache;
    }

    TemporaryFolder folder;
    std::optional<EnvironmentVariable> cache_home;
    EnvironmentVariable rusticl{"RUSTICL_ENABLE", "llvmpipe"};
    std::optional<Device> device;
};

TEST_P(BinaryCacheOn, SecondBuildComesFromTheCache) {
    EXPECT_FALSE(built_from_cache());
    EXPECT_TRUE(built_from_cache());
}

TEST_P(BinaryCacheOn, ADamagedEntryIsBuiltAgainAndReplaced) {
    built_from_cache();
    const std::filesystem::path entry = only_entry_of(folder);
    std::ifstream file(entry, std::ios::binary);
    const std::string intact(std::istreambuf_iterator<char>(file), {});
    std::string flipped = intact;
    flipped[flipped.size() - 10] ^= 1;
    for (const std::string& damaged :
         {flipped, intact.substr(0, intact.size() / 2), intact.substr(0, 20), std::string()}) {
        std::ofstream(entry, std::ios::binary) << damaged;
        EXPECT_FALSE(built_from_cache());
        EXPECT_TRUE(built_from_cache());
    }
}

// As after an update of the driver that kept its version number.
TEST_P(BinaryCacheOn, ABinaryTheDriverRefusesIsBuiltAgain) {
    if (GetParam() == std::string("rusticl"))
        GTEST_SKIP() << "Rusticl 22.3 ends the process where a binary is none of its own";
    std::string options = "-cl-std=CL1.2";
    if (device->info.correctly_rounded) options += " -cl-fp32-correctly-rounded-divide-sqrt";
    const BinaryCache cache(*device, source, options);
    cache.store({'n', 'o', ' ', 'p', 'r', 'o', 'g', 'r', 'a', 'm'});
    ASSERT_EQ(only_entry_of(folder), cache.path());
    EXPECT_FALSE(built_from_cache());
    EXPECT_TRUE(built_from_cache());
}

TEST_P(BinaryCacheOn, AFolderThatCannotBeWrittenIsNoError) {
    const EnvironmentVariable cache(
        "XDG_CACHE_HOME", folder.write("file", "not a folder").string());
    EXPECT_FALSE(built_from_cache());
    EXPECT_FALSE(built_from_cache());
}

INSTANTIATE_TEST_SUITE_P(
    Drivers, BinaryCacheOn, testing::Values("pocl", "rusticl"), [](const auto& info) {
        return std::string(info.param);
    });

TEST(BinaryCache, EveryPartOfTheKeyCounts) {
    const Device device = *open("pocl");
    const TemporaryFolder folder;
    const EnvironmentVariable variable("XDG_CACHE_HOME", folder.path().string());
    const auto path = BinaryCache(device, source, "").path();
    EXPECT_EQ(BinaryCache(device, source, "").path(), path);
    EXPECT_NE(BinaryCache(device, "", "").path(), path);
    EXPECT_NE(BinaryCache(device, source, "-x").path(), path);
    for (auto field :
         {&DeviceInfo::platform, &DeviceInfo::name, &DeviceInfo::version, &DeviceInfo::driver}) {
        Device other = device;
        other.info.*field += " 2";
        EXPECT_NE(BinaryCache(other, source, "").path(), path);
    }
}

TEST(BinaryCache, LiesWhereXdgSays) {
    const Device device = *open("pocl");
    const EnvironmentVariable home("HOME", "/home/somebody");
    {
        const EnvironmentVariable relative("XDG_CACHE_HOME", "relative");
        EXPECT_EQ(
            BinaryCache(device, source, "").path().parent_path(), "/home/somebody/.cache/wavepath");
    }
    const EnvironmentVariable cache("XDG_CACHE_HOME");
    EXPECT_EQ(
        BinaryCache(device, source, "").path().parent_path(), "/home/somebody/.cache/wavepath");
    const EnvironmentVariable homeless("HOME");
    EXPECT_TRUE(BinaryCache(device, source, "").path().empty());
}

// Another process replaces the entry while this one reads it.
TEST(BinaryCache, AnEntryIsWholeWhileAnotherProcessWritesIt) {
    const Device device = *open("pocl");
    const TemporaryFolder folder;
    const EnvironmentVariable variable("XDG_CACHE_HOME", folder.path().string());
    const BinaryCache cache(device, source, "");
    const std::vector<unsigned char> ours(std::size_t{1} << 20U, 'b');
    const std::vector<unsigned char> theirs(std::size_t{1} << 20U, 'a');
    const pid_t writer = fork();
    if (writer == 0) {
        for (int i = 0; i < 200; ++i) cache.store(theirs);
        _exit(0);
    }
    int status = 0;
    while (waitpid(writer, &status, WNOHANG) == 0) {
        cache.store(ours);
        const auto binary = cache.load();
        ASSERT_TRUE(binary.has_value()) << "an entry of two processes, or half of one";
        ASSERT_TRUE(*binary == ours || *binary == theirs);
    }
    EXPECT_EQ(status, 0);
    EXPECT_EQ(only_entry_of(folder), cache.path()) << "a temporary was left";
}

// Off PoCL, that is: fetching a binary of PoCL's takes seconds.
TEST(BinaryCache, PoclKeepsItsOwn) {
    EXPECT_TRUE(BinaryCache(open_device(""), source, "").path().empty());
}

}  // namespace
}  // namespace wavepath
