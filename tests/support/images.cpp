#include "support/images.h"

#include <cmath>
#include <cstring>
#include <string_view>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#include <stb_image_write.h>

namespace wavepath {

namespace {

void append(void* text, void* data, int size) {
    static_cast<std::string*>(text)->append(
        static_cast<const char*>(data), static_cast<std::size_t>(size));
}

constexpr std::string_view digits =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

std::string bytes_of(std::string_view base64) {
    std::string bytes;
    uint32_t bits = 0;
    int count = 0;
    for (const char c : base64) {
        const std::size_t digit = digits.find(c);
        if (digit == std::string_view::npos) break;
        bits = bits << 6U | static_cast<uint32_t>(digit);
        count += 6;
        if (count < 8) continue;
        count -= 8;
        bytes += static_cast<char>(bits >> static_cast<uint32_t>(count) & 255U);
    }
    return bytes;
}

}  // namespace

std::string png_file(uint32_t width, uint32_t height, const std::vector<uint8_t>& rgba) {
    std::string bytes;
    const auto w = static_cast<int>(width);
    stbi_write_png_to_func(append, &bytes, w, static_cast<int>(height), 4, rgba.data(), 4 * w);
    return bytes;
}

std::string jpeg_file(uint32_t width, uint32_t height, const std::vector<uint8_t>& rgba) {
    std::string bytes;
    stbi_write_jpg_to_func(
        append, &bytes, static_cast<int>(width), static_cast<int>(height), 4, rgba.data(), 95);
    return bytes;
}

std::string wide_png_file() {
    return bytes_of(
        "iVBORw0KGgoAAAANSUhEUgAAAAIAAAABEAYAAACksqPJAAAAGUlEQVR4nGNgYGhg+P/"
        "fwJKBkYGJgZmBBQAh+QLyBN061wAAAABJRU5ErkJggg==");
}

std::string gamma_png_file() {
    return bytes_of(
        "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAABGdBTUEAAYagMeiWXwAAAApJREFUeJxjaAAAAIIAgX"
        "fNcrYAAAAASUVORK5CYII=");
}

std::string webp_file() {
    return bytes_of("UklGRhYAAABXRUJQVlA4TAoAAAAvAUAAAOh/ZP8D");
}

std::string base64_of(const std::string& bytes) {
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        uint32_t block = 0;
        for (std::size_t k = i; k < i + 3; ++k)
            block = block << 8U | (k < bytes.size() ? static_cast<uint8_t>(bytes[k]) : 0U);
        for (uint32_t k = 0; k < 4; ++k)
            text += i + k > bytes.size() ? '=' : digits[block >> (18 - 6 * k) & 63U];
    }
    return text;
}

TextureImage image_of(uint32_t width, uint32_t height, const std::vector<uint8_t>& rgba) {
    TextureImage image;
    image.width = width;
    image.height = height;
    image.words.resize(std::size_t{width} * height);
    std::memcpy(image.words.data(), rgba.data(), rgba.size());
    return image;
}

TextureImage texel_image(double r, double g, double b, double a) {
    TextureImage image;
    image.width = 1;
    image.height = 1;
    image.wide = true;
    const auto code = [](double x) { return static_cast<uint32_t>(std::lround(65535 * x)); };
    image.words = {code(r) | code(g) << 16U, code(b) | code(a) << 16U};
    return image;
}

Texture& add_texture(Scene& scene, Material& material, TextureUse use, TextureImage image) {
    Texture& texture = material.textures[use];
    texture.image = static_cast<uint32_t>(scene.images.size());
    scene.images.push_back(std::move(image));
    if (material.uv_sets.empty()) material.uv_sets = {0};
    return texture;
}

}  // namespace wavepath
