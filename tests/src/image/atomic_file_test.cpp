#include "image/atomic_file.h"

#include "support/temporary_folder.h"

#include <gmock/gmock.h>
#include <sys/resource.h>

#include <csignal>

namespace wavepath {
namespace {

using testing::HasSubstr;

// While it lives, no file of this process grows beyond `bytes`: a full disk, as far as fwrite can
// tell.
class FileSizeLimit {
  public:
    explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
        getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit limit{bytes, before_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    FileSizeLimit(const FileSizeLimit&) = delete;
    FileSizeLimit& operator=(const FileSizeLimit&) = delete;
    ~FileSizeLimit() {
        setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }

  private:
    void (*handler_)(int);
    rlimit before_{};
};

TEST(AtomicFile, AppearsOnCommitAndReplacesWhatWasThere) {
    const TemporaryFolder folder;
    const auto path = folder.write("a.bin", "old and longer");
    {
        AtomicFile file(path);
        EXPECT_EQ(folder.read("a.bin"), "old and longer");
        file.commit({"n\0w", 3});
        EXPECT_EQ(folder.read("a.bin"), std::string("n\0w", 3));
    }
    EXPECT_EQ(folder.read("a.bin"), std::string("n\0w", 3));
    EXPECT_EQ(folder.file_count(), 1u);
}

TEST(AtomicFile, LeavesNothingWithoutCommit) {
    const TemporaryFolder folder;
    { const AtomicFile file(folder / "a.bin"); }
    EXPECT_EQ(folder.file_count(), 0u);
}

TEST(AtomicFile, KeepsTheOldFileWhereTheDiskIsFull) {
    const TemporaryFolder folder;
    const auto path = folder.write("a.bin", "old");
    // Fails in fwrite, which passes large blocks on, and in fclose, which flushes small ones.
    for (const std::size_t size : {std::size_t{1} << 20, std::size_t{100}}) {
        EXPECT_THAT(
            error_of([&] {
                const FileSizeLimit limit(10);
                AtomicFile(path).commit(std::string(size, 'x'));
            }),
            HasSubstr(path.string() + ": cannot be written: File too large; "));
        EXPECT_EQ(folder.read("a.bin"), "old");
        EXPECT_EQ(folder.file_count(), 1u);
    }
}

TEST(AtomicFile, IsWrittenInPiecesAndOverWhatIsThere) {
    const TemporaryFolder folder;
    AtomicFile file(folder / "a.bin");
    file.write("one two");
    EXPECT_EQ(file.position(), 7u);
    file.seek(4);
    file.write("six");
    file.commit(".");
    EXPECT_EQ(folder.read("a.bin"), "one six.");
}

// As OpenEXR does at the end of a file.
TEST(AtomicFile, KeepsAFailureThatItsWriterDropped) {
    const TemporaryFolder folder;
    const auto path = folder.write("a.bin", "old");
    AtomicFile file(path);
    {
        const FileSizeLimit limit(10);
        EXPECT_THROW(file.write(std::string(std::size_t{1} << 20, 'x')), Error);
    }
    EXPECT_THAT(error_of([&] { file.commit({}); }), HasSubstr("File too large"));
    EXPECT_EQ(folder.read("a.bin"), "old");
}

TEST(AtomicFile, SaysThatItsFolderIsGone) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "gone");
    AtomicFile file(folder / "gone/a.bin");
    std::filesystem::remove_all(folder / "gone");
    EXPECT_THAT(
        error_of([&] { file.commit("x"); }),
        HasSubstr("gone/a.bin: cannot be written: No such file"));
    EXPECT_EQ(folder.file_count(), 0u);
}

TEST(AtomicFile, RemovesTheTemporaryWhereRenamingFails) {
    const TemporaryFolder folder;
    AtomicFile file(folder / "a");
    std::filesystem::create_directory(folder / "a");
    EXPECT_THAT(
        error_of([&] { file.commit("x"); }), HasSubstr("a: cannot be written: Is a directory"));
    EXPECT_THAT(
        error_of([&] { AtomicFile again(folder / "a"); }),
        HasSubstr("is not the name of a regular file"));
}

TEST(AtomicFile, RefusesWhatIsNoFile) {
    const TemporaryFolder folder;
    const auto file = folder.write("file", "");
    const auto message = [](const std::filesystem::path& path) {
        return error_of([&] { const AtomicFile unused(path); });
    };
    EXPECT_EQ(message(""), "\"\": is not the name of a regular file; choose another");
    for (const std::filesystem::path& path :
         {folder.path(), folder / "new/", std::filesystem::path("/dev/null")}) {
        EXPECT_THAT(message(path), HasSubstr("is not the name of a regular file")) << path;
    }
    EXPECT_EQ(
        message(folder / "none/a.exr"),
        (folder / "none/a.exr").string() + ": cannot be written: folder " +
            (folder / "none").string() +
            ": No such file or directory; choose another or see to it");
    EXPECT_THAT(message(file / "a.exr"), HasSubstr("Not a directory"));
    EXPECT_THAT(message(folder / std::string(256, 'a')), HasSubstr("File name too long"));
    EXPECT_THAT(
        message("/proc/a.exr"), HasSubstr("folder /proc: "));  // where not even root may write
    EXPECT_EQ(folder.file_count(), 1u);
}

TEST(AtomicFile, TakesTheLongestNameOfTheFileSystem) {
    const TemporaryFolder folder;
    const std::string name(255, 'a');
    AtomicFile(folder / name).commit("x");
    EXPECT_EQ(folder.read(name), "x");
}

TEST(AtomicFile, WritesThroughALink) {
    const TemporaryFolder folder;
    folder.write("target", "old");
    std::filesystem::create_symlink("target", folder / "link");
    AtomicFile(folder / "link").commit("new");
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
    EXPECT_EQ(folder.read("target"), "new");
}

}  // namespace
}  // namespace wavepath
