#include "device/binary_cache.h"

#include "device/selection.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string_view>
#include <system_error>

namespace wavepath {

namespace {

constexpr int format_version = 1;  // of the entries: raised when their layout changes

// FNV-1a in 128 bits, as hexadecimal digits (Fowler, Noll, Vo, Eastlake: "The FNV non-cryptographic
// hash algorithm").
std::string hash_of(std::string_view bytes) {
    __extension__ using Hash = unsigned __int128;
    Hash hash = (Hash{0x6c62272e07bb0142U} << 64U) | 0x62b821756295c58dU;
    const Hash prime = (Hash{0x0000000001000000U} << 64U) | 0x000000000000013bU;
    for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * prime;
    return fmt::format(
        "{:016x}{:016x}", static_cast<uint64_t>(hash >> 64U), static_cast<uint64_t>(hash));
}

// The XDG base directory rules: a relative XDG_CACHE_HOME is to be ignored.
std::filesystem::path cache_folder() {
    const char* xdg = std::getenv("XDG_CACHE_HOME");
    if (xdg != nullptr && std::filesystem::path(xdg).is_absolute())
        return std::filesystem::path(xdg) / "wavepath";
    const char* home = std::getenv("HOME");
    if (home != nullptr && *home != '\0')
        return std::filesystem::path(home) / ".cache" / "wavepath";
    return {};
}

std::string_view view(const std::vector<unsigned char>& bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

BinaryCache::BinaryCache(
    const Device& device, const std::string& source, const std::string& options) {
    const std::filesystem::path folder = cache_folder();
    if (is_pocl(device.info) || folder.empty()) return;
    const cl::Platform platform(device.device.getInfo<CL_DEVICE_PLATFORM>());
    identity_ = fmt::format(
        "wavepath program {}\n{}\n{}\n{}\n{}\n{}\n{}\n{}\n", format_version, device.info.platform,
        platform.getInfo<CL_PLATFORM_VERSION>(), device.info.name, device.info.version,
        device.info.driver, options, hash_of(source));
    path_ = folder / (hash_of(identity_) + ".bin");
}

std::optional<std::vector<unsigned char>> BinaryCache::load() const {
    std::ifstream file(path_, std::ios::binary);
    if (path_.empty() || !file) return std::nullopt;
    const std::string entry(std::istreambuf_iterator<char>(file), {});
    // identity, hash of the binary, newline, binary
    const std::size_t binary_at = identity_.size() + hash_of("").size() + 1;
    if (entry.size() <= binary_at || !entry.starts_with(identity_)) return std::nullopt;
    const std::string_view binary = std::string_view(entry).substr(binary_at);
    if (entry.compare(identity_.size(), hash_of("").size(), hash_of(binary)) != 0)
        return std::nullopt;
    return std::vector<unsigned char>(binary.begin(), binary.end());
}

void BinaryCache::store(const std::vector<unsigned char>& binary) const {
    if (path_.empty() || binary.empty()) return;
    std::error_code failed;
    std::filesystem::create_directories(path_.parent_path(), failed);
    const std::filesystem::path temporary = fmt::format("{}.{}", path_.string(), getpid());
    std::ofstream file(temporary, std::ios::binary);
    file << identity_ << hash_of(view(binary)) << '\n' << view(binary);
    file.close();
    if (file) std::filesystem::rename(temporary, path_, failed);
    if (!file || failed) std::filesystem::remove(temporary, failed);
}

}  // namespace wavepath
