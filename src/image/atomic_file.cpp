#include "image/atomic_file.h"

#include "error.h"

#include <cerrno>
#include <cstring>
#include <random>

namespace wavepath {
namespace fs = std::filesystem;

AtomicFile::AtomicFile(const fs::path& path) : path_(path) {
    std::error_code failure;
    const fs::file_status status = fs::status(path, failure);
    // Too long, a loop of links, a folder that must not be searched.
    if (status.type() == fs::file_type::none) {
        throw Error(
            "{}: cannot be written: {}; choose another name", path.string(), failure.message());
    }
    if (!path.has_filename() || (fs::exists(status) && !fs::is_regular_file(status))) {
        throw Error("\"{}\": is not the name of a regular file; choose another", path.string());
    }
    if (fs::exists(status)) path_ = fs::canonical(path);  // replace the file, not a link to it

    // A name of its own length: the file's may be as long as the file system permits.
    const fs::path folder = path_.has_parent_path() ? path_.parent_path() : ".";
    std::random_device random;
    do {
        temporary_ = folder / fmt::format("wavepath-{:08x}.tmp", random());
        file_.reset(std::fopen(temporary_.c_str(), "wbx"));
    } while (!file_ && errno == EEXIST);
    if (!file_) {
        temporary_.clear();
        throw Error(
            "{}: cannot be written: folder {}: {}; choose another or see to it", path.string(),
            folder.string(), std::strerror(errno));
    }
}

AtomicFile::~AtomicFile() {
    std::error_code ignored;  // there is no one left to tell
    if (!temporary_.empty()) fs::remove(temporary_, ignored);
}

void AtomicFile::check(bool succeeded) {
    if (!succeeded && !failure_) failure_.assign(errno, std::generic_category());
    if (failure_)
        throw Error(
            "{}: cannot be written: {}; check space and rights in its folder or choose another",
            path_.string(), failure_.message());
}

void AtomicFile::write(std::string_view bytes) {
    check(std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) == bytes.size());
}

void AtomicFile::seek(uint64_t position) {
    check(fseeko(file_.get(), static_cast<off_t>(position), SEEK_SET) == 0);
}

uint64_t AtomicFile::position() const {
    return static_cast<uint64_t>(ftello(file_.get()));
}

void AtomicFile::commit(std::string_view bytes) {
    write(bytes);
    check(std::fclose(file_.release()) == 0);  // flushes what fwrite kept
    check(std::rename(temporary_.c_str(), path_.c_str()) == 0);
    temporary_.clear();
}

}  // namespace wavepath
