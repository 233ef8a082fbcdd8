#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string_view>

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

    // Writes the whole content and gives the file its name, once. Throws Error where either fails.
    void commit(std::string_view bytes);

  private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };

    std::filesystem::path path_;
    std::filesystem::path temporary_;  // empty: nothing to remove
    std::unique_ptr<std::FILE, Close> file_;
};

}  // namespace wavepath
