// Program binaries kept between runs.
#pragma once

#include "device/device.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace wavepath {

// The cache entry of one program. Where there is no folder to keep it in, and on PoCL, which has a
// cache of its own and takes seconds to hand a binary out, load() finds nothing and store() does
// nothing.
class BinaryCache {
  public:
    BinaryCache(const Device& device, const std::string& source, const std::string& options);

    // The binary, if the entry is there and intact.
    std::optional<std::vector<unsigned char>> load() const;

    // Writes to a temporary name and renames, so that another process reads an entry whole or not
    // at all. A folder that cannot be written is no error: the next run builds again.
    void store(const std::vector<unsigned char>& binary) const;

    const std::filesystem::path& path() const { return path_; }  // empty: nothing is cached

  private:
    std::string identity_;  // the entry's first lines: what the binary was built from and for
    std::filesystem::path path_;
};

}  // namespace wavepath
