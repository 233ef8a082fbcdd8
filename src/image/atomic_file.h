#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string_view>
#include <system_error>

namespace wavepath {

// A file that appears under its name whole or not at all: written under a temporary name in the
// same folder, then renamed. Until commit() has returned, the path holds what was there before.
class AtomicFile {
  public:
    // Creates the temporary. Throws Error where `path` names no file or its folder takes none.
    explicit AtomicFile(const std::filesystem::path& path);
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;
    ~AtomicFile();

    // Writes at the file's position, or moves that to a byte of what is there. Throws Error where
    // it fails; then commit() does too, for the sake of writers who drop exceptions.
    void write(std::string_view bytes);
    void seek(uint64_t position);
    uint64_t position() const;

    // Writes the last of the content and gives the file its name, once. Throws Error where that
    // fails.
    void commit(std::string_view bytes);

  private:
    void check(bool succeeded);  // throws Error if it, or anything before, did not

    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };

    std::filesystem::path path_;
    std::filesystem::path temporary_;  // empty: nothing to remove
    std::unique_ptr<std::FILE, Close> file_;
    std::error_code failure_;  // the first
};

}  // namespace wavepath
