#include "gltf/image_decoder.h"

#include "error.h"

#include <webp/decode.h>
#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <memory>
#include <numeric>

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC  // libtinygltf brings another copy
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#include <stb_image.h>

namespace wavepath {
namespace {

using Bytes = std::span<const unsigned char>;

constexpr const char* unknown_kind =
    "is no PNG, JPEG or WebP image; convert it, or check that it is complete";
constexpr const char* damaged_chunk = "is damaged (a checksum is wrong); export it again";

bool is_webp(Bytes bytes) {
    return bytes.size() >= 12 && std::memcmp(bytes.data(), "RIFF", 4) == 0 &&
           std::memcmp(bytes.data() + 8, "WEBP", 4) == 0;
}

uint32_t big_endian(Bytes bytes) {
    return uint32_t{bytes[0]} << 24U | uint32_t{bytes[1]} << 16U | uint32_t{bytes[2]} << 8U |
           uint32_t{bytes[3]};
}

// stb_image looks at no checksum, and paints what it can of damaged files. Chunks that do not
// matter to the picture may be damaged [PNG 3, sections 5.3 to 5.5].
bool has_damaged_chunks(Bytes bytes) {
    constexpr unsigned char signature[] = {137, 'P', 'N', 'G', '\r', '\n', 26, '\n'};
    constexpr std::size_t frame = 12;  // length, type, checksum
    if (bytes.size() < sizeof signature ||
        std::memcmp(bytes.data(), signature, sizeof signature) != 0)
        return false;
    bytes = bytes.subspan(sizeof signature);
    while (bytes.size() >= frame && big_endian(bytes) <= bytes.size() - frame) {
        const std::size_t length = big_endian(bytes);
        const Bytes checked = bytes.subspan(4, 4 + length);
        const bool matters = checked[0] < 'a' || std::memcmp(checked.data(), "tRNS", 4) == 0;
        if (matters &&
            crc32_z(0, checked.data(), checked.size()) != big_endian(bytes.subspan(8 + length)))
            return true;
        bytes = bytes.subspan(frame + length);
    }
    return false;  // what is cut off the decoder finds
}

// stb_image writes beyond its tables where a Huffman table has more than 256 codes [ITU T.81,
// section B.2.4.2]: every such table of the file is looked at before.
bool has_overfull_huffman_tables(Bytes bytes) {
    if (bytes.size() < 2 || bytes[0] != 0xFF || bytes[1] != 0xD8) return false;
    bytes = bytes.subspan(2);
    while (bytes.size() >= 4) {
        const unsigned marker = bytes[1];
        const bool has_segment =
            bytes[0] == 0xFF && marker > 1 && marker != 0xFF && (marker < 0xD0 || marker > 0xD9);
        const std::size_t length = std::size_t{bytes[2]} << 8U | bytes[3];
        if (!has_segment || length < 2 || length > bytes.size() - 2) {
            bytes = bytes.subspan(1);
            continue;
        }
        Bytes tables = bytes.subspan(4, length - 2);
        while (marker == 0xC4 && tables.size() >= 17) {
            const Bytes counts = tables.subspan(1, 16);
            const std::size_t codes = std::accumulate(counts.begin(), counts.end(), std::size_t{0});
            if (codes > 256) return true;
            tables = tables.subspan(std::min(17 + codes, tables.size()));
        }
        bytes = bytes.subspan(2 + length);
    }
    return false;
}

// stb_image takes the end of a file for zeros, and paints what is cut off grey: this source
// remembers that it was asked for more than there is.
struct Source {
    Bytes left;
    bool exhausted = false;

    static int read(void* user, char* data, int size) {
        auto& [left, exhausted] = *static_cast<Source*>(user);
        const std::size_t count = std::min(left.size(), static_cast<std::size_t>(size));
        std::copy_n(left.data(), count, data);
        left = left.subspan(count);
        exhausted = exhausted || count == 0;
        return static_cast<int>(count);
    }
    static void skip(void* user, int size) {
        auto& [left, exhausted] = *static_cast<Source*>(user);
        const auto wanted = static_cast<std::size_t>(size);
        exhausted = exhausted || wanted > left.size();
        left = left.subspan(std::min(wanted, left.size()));
    }
    static int at_end(void* user) { return static_cast<Source*>(user)->left.empty(); }
};

constexpr stbi_io_callbacks callbacks{Source::read, Source::skip, Source::at_end};

struct Free {
    void operator()(void* pixels) const { stbi_image_free(pixels); }
    void operator()(std::uint8_t* pixels) const { WebPFree(pixels); }
};

TextureImage with_size(int width, int height) {
    TextureImage image;
    image.width = static_cast<uint32_t>(width);
    image.height = static_cast<uint32_t>(height);
    return image;
}

void copy_texels(TextureImage& image, const void* texels) {
    image.words.resize(std::size_t{image.wide ? 2U : 1U} * image.width * image.height);
    std::memcpy(image.words.data(), texels, image.words.size() * sizeof(uint32_t));
}

TextureImage decode_webp(Bytes bytes) {
    int width = 0;
    int height = 0;
    const std::unique_ptr<std::uint8_t, Free> texels(
        WebPDecodeRGBA(bytes.data(), bytes.size(), &width, &height));
    if (!texels) throw Error("is a damaged WebP image; export it again");
    TextureImage image = with_size(width, height);
    copy_texels(image, texels.get());
    return image;
}

}  // namespace

ImageSize read_image_size(Bytes bytes) {
    int width = 0;
    int height = 0;
    int channels = 0;
    if (bytes.size() > std::numeric_limits<int>::max())
        throw Error("is larger than 2 GiB; shrink it");
    const bool known =
        is_webp(bytes)
            ? WebPGetInfo(bytes.data(), bytes.size(), &width, &height) != 0
            : stbi_info_from_memory(
                  bytes.data(), static_cast<int>(bytes.size()), &width, &height, &channels) != 0;
    if (!known && has_damaged_chunks(bytes)) throw Error("{}", damaged_chunk);
    if (!known || width < 1 || height < 1) throw Error("{}", unknown_kind);
    return {static_cast<uint32_t>(width), static_cast<uint32_t>(height)};
}

TextureImage decode_image(Bytes bytes) {
    if (is_webp(bytes)) return decode_webp(bytes);
    if (has_overfull_huffman_tables(bytes))
        throw Error("is damaged (a Huffman table has too many codes); export it again");
    if (has_damaged_chunks(bytes)) throw Error("{}", damaged_chunk);
    int width = 0;
    int height = 0;
    int channels = 0;
    const bool wide = stbi_is_16_bit_from_memory(bytes.data(), static_cast<int>(bytes.size())) != 0;
    Source source{bytes};
    const std::unique_ptr<void, Free> texels(
        wide ? static_cast<void*>(
                   stbi_load_16_from_callbacks(&callbacks, &source, &width, &height, &channels, 4))
             : static_cast<void*>(
                   stbi_load_from_callbacks(&callbacks, &source, &width, &height, &channels, 4)));
    if (source.exhausted) throw Error("is cut off; copy or export it again");
    if (!texels) throw Error("is damaged ({}); export it again", stbi_failure_reason());
    TextureImage image = with_size(width, height);
    image.wide = wide;
    copy_texels(image, texels.get());
    return image;
}

}  // namespace wavepath
