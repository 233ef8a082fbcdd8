// What PoCL does where its kernel cache is damaged or full is said in one line.
#include "device/driver_failure.h"

#include "support/command.h"

#include <gmock/gmock.h>

#include <csignal>
#include <filesystem>

namespace wavepath {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

class DriverFailure : public CommandTest {
  protected:
    Outcome render_with(const std::string& cache) const {
        return run(
            "render " + cornell_box + " --device cpu --size 4x4 --spp 1 --quiet -o " +
                path("a.exr"),
            "POCL_CACHE_DIR=" + path(cache));
    }

    // Cuts every file of this kind to `bytes`.
    void damage(const std::string& cache, const std::string& extension, uint64_t bytes) const {
        for (const auto& entry : fs::recursive_directory_iterator(folder / cache))
            if (entry.path().extension() == extension) fs::resize_file(entry.path(), bytes);
    }
};

TEST_F(DriverFailure, DamagedCacheIsSaid) {
    const Outcome whole = render_with("whole");
    ASSERT_EQ(whole.exit_code, 0) << whole.words;
    for (const auto& [extension, bytes] :
         {std::pair{".bc", 0}, {".bc", 100}, {".so", 0}, {".so", 4096}, {".so", 9000}}) {
        SCOPED_TRACE(testing::Message() << extension << " of " << bytes << " bytes");
        fs::remove_all(folder / "damaged");
        fs::remove(folder / "a.exr");
        fs::copy(folder / "whole", folder / "damaged", fs::copy_options::recursive);
        damage("damaged", extension, static_cast<uint64_t>(bytes));
        const Outcome outcome = render_with("damaged");
        EXPECT_EQ(outcome.exit_code, 1) << outcome.words;
        EXPECT_THAT(outcome.words, HasSubstr("its kernel cache " + path("damaged")));
        EXPECT_FALSE(fs::exists(folder / "a.exr"));
    }
}

TEST_F(DriverFailure, DriverThatExitsIsSaid) {
    EXPECT_EXIT(
        {
            const DriverFailureGuard guard;
            std::exit(1);  // as LLVM does where a disk is full
        },
        testing::ExitedWithCode(1), "error: the OpenCL driver failed.*POCL_CACHE_DIR");
    EXPECT_EXIT(
        {
            { const DriverFailureGuard guard; }
            std::exit(0);
        },
        testing::ExitedWithCode(0), "^$");
    EXPECT_EXIT(
        {
            { const DriverFailureGuard guard; }
            std::raise(SIGSEGV);
        },
        testing::KilledBySignal(SIGSEGV), "");
}

// PoCL aborts where it cannot start its threads.
TEST_F(DriverFailure, ShortMemoryIsSaid) {
    for (const char* kibibytes : {"200000", "300000", "400000", "500000"}) {
        const Outcome outcome =
            run("render " + cornell_box + " --size 4x4 --spp 1 --quiet -o " + path("a.exr"),
                std::string("ulimit -v ") + kibibytes + ";");
        EXPECT_EQ(outcome.exit_code, 1) << kibibytes;
        EXPECT_THAT(outcome.words, HasSubstr("ulimit -v")) << kibibytes;
    }
}

TEST_F(DriverFailure, MoreThreadsThanCpusAreTakenAsOneEach) {
    const std::string tiny = "render " + cornell_box + " --size 4x4 --spp 1 -o " + path("a.exr");
    for (const char* threads : {"64", "100000", "-3"}) {
        const Outcome outcome = run(tiny, std::string("POCL_MAX_PTHREAD_COUNT=") + threads);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.words;
        EXPECT_THAT(
            outcome.words,
            HasSubstr("warning: POCL_MAX_PTHREAD_COUNT=" + std::string(threads) + ": there are "));
    }
    EXPECT_THAT(
        run(tiny, "POCL_MAX_PTHREAD_COUNT=1").words,
        testing::Not(HasSubstr("POCL_MAX_PTHREAD_COUNT")));
}

}  // namespace
}  // namespace wavepath
