#include "prepare/texture_tables.h"

#include "error.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace wavepath {
namespace {

// IEC 61966-2-1.
double linear_of_srgb(double c) {
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

void append_curve(std::vector<uint32_t>& words, uint32_t codes) {
    for (uint32_t code = 0; code < codes; ++code)
        words.push_back(std::bit_cast<uint32_t>(
            static_cast<float>(linear_of_srgb(double{1} * code / (codes - 1)))));
}

uint32_t wrap_bits(const Texture& texture) {
    uint32_t bits = 0;
    if (texture.wrap_s == Wrap::clamp) bits |= TEXTURE_CLAMP_S;
    if (texture.wrap_s == Wrap::mirror) bits |= TEXTURE_MIRROR_S;
    if (texture.wrap_t == Wrap::clamp) bits |= TEXTURE_CLAMP_T;
    if (texture.wrap_t == Wrap::mirror) bits |= TEXTURE_MIRROR_T;
    return bits;
}

DeviceTexture texture_row(
    const Scene& scene, const TextureTables& tables, const Material& material, TextureUse use) {
    DeviceTexture row{};
    row.scale = use == TEXTURE_NORMAL ? material.normal_scale : material.alpha;
    row.cutoff = material.alpha_cutoff;
    if (use == TEXTURE_BASE_COLOR && material.alpha_mode == AlphaMode::mask)
        row.flags |= TEXTURE_MASK;
    if (use == TEXTURE_BASE_COLOR && material.alpha_mode == AlphaMode::blend)
        row.flags |= TEXTURE_BLEND;
    if (use == TEXTURE_EMISSION && material.unlit) row.flags |= TEXTURE_TINTED;
    if (!material.has(use)) return row;

    const Texture& texture = material.texture(use);
    const TextureImage& image = scene.images[*texture.image];
    row.first_word = tables.first_words[*texture.image];
    row.width = image.width;
    row.height = image.height;
    row.flags |= wrap_bits(texture);
    if (texture.nearest) row.flags |= TEXTURE_NEAREST;
    if (image.wide) row.flags |= TEXTURE_16_BITS;
    if (texture.srgb) row.flags |= TEXTURE_SRGB;
    if (texture.uvs == 1) row.flags |= TEXTURE_SECOND_UVS;
    const auto& m = texture.transform;
    row.s_u = m[0];
    row.s_v = m[1];
    row.s_1 = m[2];
    row.t_u = m[3];
    row.t_v = m[4];
    row.t_1 = m[5];
    return row;
}

std::size_t wrapped(Wrap wrap, double given, uint32_t size) {
    const double coordinate = std::fmax(std::fmin(given, 0x1p30), -0x1p30);
    const double repeated = coordinate - std::floor(coordinate);
    const double turn = 2 * (coordinate / 2 - std::floor(coordinate / 2));
    const double within = wrap == Wrap::clamp    ? std::clamp(coordinate, 0.0, 1.0)
                          : wrap == Wrap::mirror ? std::min(turn, 2 - turn)
                                                 : repeated;
    return std::min(static_cast<std::size_t>(within * size), std::size_t{size} - 1);
}

double texel_luminance(const Texture& texture, const TextureImage& image, std::size_t index) {
    constexpr std::array<double, 3> weights{0.2126, 0.7152, 0.0722};
    const double most = image.wide ? 65535 : 255;
    double sum = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        const uint32_t code = image.wide ? image.words[2 * index + c / 2] >> (16 * (c % 2)) & 65535U
                                         : image.words[index] >> (8 * c) & 255U;
        sum += weights[c] * (texture.srgb ? linear_of_srgb(code / most) : code / most);
    }
    return sum;
}

}  // namespace

uint32_t TextureTables::pages() const {
    return page_words == 0 ? 0 : static_cast<uint32_t>((words + page_words - 1) / page_words);
}

TextureTables build_texture_tables(
    const Scene& scene, const std::vector<bool>& used, uint64_t page_bytes, bool always) {
    TextureTables tables;
    bool needed = always;
    bool srgb = false;
    bool wide_srgb = false;
    for (std::size_t m = 0; m < scene.materials.size(); ++m) {
        const Material& material = scene.materials[m];
        if (!used[m]) continue;
        needed = needed || material.alpha_mode != AlphaMode::opaque || material.unlit;
        for (const Texture& texture : material.textures) {
            if (!texture.image) continue;
            needed = true;
            srgb = srgb || texture.srgb;
            wide_srgb = wide_srgb || (texture.srgb && scene.images[*texture.image].wide);
        }
    }
    if (!needed) return tables;

    if (srgb) append_curve(tables.curves, 256);
    if (wide_srgb) append_curve(tables.curves, 65536);
    tables.words = tables.curves.size();
    for (const TextureImage& image : scene.images) {
        tables.first_words.push_back(static_cast<uint32_t>(tables.words));
        tables.words += image.words.size();
    }
    if (tables.words > 0)
        tables.page_words =
            std::min<uint64_t>(page_bytes / sizeof(uint32_t), std::numeric_limits<uint32_t>::max());
    if (tables.pages() > TEXTURE_MOST_PAGES || tables.words > std::numeric_limits<uint32_t>::max())
        throw Error(
            "{}: textures take {} MiB, the device holds {} MiB; shrink them, or use another "
            "--device",
            scene.name, tables.words >> 18U, TEXTURE_MOST_PAGES * page_bytes >> 20U);

    for (const Material& material : scene.materials)
        for (int use = 0; use < TEXTURE_USES; ++use)
            tables.rows.push_back(
                texture_row(scene, tables, material, static_cast<TextureUse>(use)));
    return tables;
}

TextureLuminance::TextureLuminance(const Texture& texture, const TextureImage& image)
    : texture_(texture), width_(image.width), height_(image.height) {
    texels_.resize(std::size_t{width_} * height_);
    for (std::size_t i = 0; i < texels_.size(); ++i) {
        texels_[i] = static_cast<float>(texel_luminance(texture, image, i));
        whole_ += texels_[i] / static_cast<double>(texels_.size());
    }
}

double TextureLuminance::over(const float* uvs) const {
    constexpr int steps = 12;
    constexpr double share_of_whole = 1.0 / 16;
    const auto& m = texture_.transform;
    double sum = 0;
    int points = 0;
    for (int i = 0; i < steps; ++i) {
        for (int j = 0; i + j < steps; ++j, ++points) {
            const double u = (i + 1.0 / 3) / steps;
            const double v = (j + 1.0 / 3) / steps;
            const double x = uvs[0] + u * (uvs[2] - uvs[0]) + v * (uvs[4] - uvs[0]);
            const double y = uvs[1] + u * (uvs[3] - uvs[1]) + v * (uvs[5] - uvs[1]);
            const std::size_t column = wrapped(texture_.wrap_s, m[0] * x + m[1] * y + m[2], width_);
            const std::size_t row = wrapped(texture_.wrap_t, m[3] * x + m[4] * y + m[5], height_);
            sum += texels_[row * width_ + column];
        }
    }
    return (1 - share_of_whole) * sum / points + share_of_whole * whole_;
}

}  // namespace wavepath
