#include "gltf/gltf_texture.h"

#include "gltf/gltf_accessor.h"
#include "gltf/image_decoder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <span>

namespace wavepath {
namespace {

constexpr bool is_srgb(TextureUse use) {
    return use == TEXTURE_BASE_COLOR || use == TEXTURE_EMISSION || use == TEXTURE_SPECULAR_COLOR;
}

Wrap wrap_of(const GltfFile& file, std::string_view where, int mode) {
    switch (mode) {
        case TINYGLTF_TEXTURE_WRAP_REPEAT:
            return Wrap::repeat;
        case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
            return Wrap::mirror;
        case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
            return Wrap::clamp;
        default:
            file.fail(where, "wrap mode {} is unknown; use 10497, 33648 or 33071", mode);
    }
}

// Of KHR_texture_transform.
std::array<double, 2> pair_of(
    const GltfFile& file,
    std::string_view where,
    const tinygltf::Value& object,
    const char* key,
    double missing) {
    const std::vector<double> values = numbers(file, where, object, key, {missing, missing});
    const auto fits = [](double x) { return std::abs(x) <= std::numeric_limits<float>::max(); };
    if (values.size() != 2 || !std::ranges::all_of(values, fits))
        file.fail(where, "{} is not a pair of numbers; repair it or export again", key);
    return {values[0], values[1]};
}

// The image's file, still encoded.
std::span<const unsigned char> encoded_bytes(
    const GltfFile& file, const tinygltf::Image& image, std::string_view where) {
    if (image.bufferView < 0) {
        if (image.image.empty())
            file.fail(
                where, "{} is missing, empty or cannot be read; put it beside the scene",
                image.uri.empty() ? "its data" : one_line(image.uri));
        return image.image;
    }
    return view_bytes(file, image.bufferView, where);
}

}  // namespace

void TextureReader::read(TextureUse use, const tinygltf::Value& extension, const char* key) {
    if (!extension.Has(key)) return;
    const tinygltf::Value& info = extension.Get(key);
    tinygltf::ExtensionMap extensions;
    if (info.Has("extensions")) {
        const tinygltf::Value& members = info.Get("extensions");
        for (const std::string& name : members.Keys()) extensions[name] = members.Get(name);
    }
    const std::string where = fmt::format("{}, {}", where_, key);
    add(use, key, integer(file_, where, info, "index"), integer(file_, where, info, "texCoord", 0),
        extensions);
}

void TextureReader::add(
    TextureUse use,
    const char* key,
    int index,
    int uv_set,
    const tinygltf::ExtensionMap& extensions) {
    const std::string place = fmt::format("{}, {}", where_, key);
    const tinygltf::Texture& source = file_.at(file_.model.textures, index, "texture", place);
    const std::string where = label("texture", index, source.name);
    int image = source.source;
    if (const auto* webp = find_extension(source.extensions, "EXT_texture_webp"))
        image = integer(file_, where, *webp, "source");
    if (image == -1)
        file_.fail(
            where, "has no image of a kind that is supported; convert it to PNG, JPEG or WebP");
    file_.at(file_.model.images, image, "image", where);

    Texture& texture = material_.textures[use];
    texture.image = static_cast<uint32_t>(image);
    texture.srgb = is_srgb(use);
    read_sampler(source.sampler, where, texture);
    if (const auto* transform = find_extension(extensions, "KHR_texture_transform"))
        uv_set = read_transform(*transform, uv_set, place, texture);
    texture.uvs = place_of_uv_set(uv_set);
}

// translation * rotation * scale; the rotation is counter-clockwise in a plane whose v points down
// [KHR_texture_transform]. Returns the set of coordinates.
int TextureReader::read_transform(
    const tinygltf::Value& transform, int uv_set, std::string_view where, Texture& texture) const {
    const auto offset = pair_of(file_, where, transform, "offset", 0);
    const auto scale = pair_of(file_, where, transform, "scale", 1);
    const double rotation = number(file_, where, transform, "rotation", 0);
    if (!std::isfinite(rotation)) file_.fail(where, "rotation is not finite; repair it");
    const double c = std::cos(rotation);
    const double s = std::sin(rotation);
    const std::array<double, 6> matrix{c * scale[0],  s * scale[1], offset[0],
                                       -s * scale[0], c * scale[1], offset[1]};
    std::ranges::transform(
        matrix, texture.transform.begin(), [](double x) { return static_cast<float>(x); });
    return transform.Has("texCoord") ? integer(file_, where, transform, "texCoord") : uv_set;
}

void TextureReader::read_sampler(int index, std::string_view where, Texture& texture) const {
    if (index == -1) return;
    const tinygltf::Sampler& sampler = file_.at(file_.model.samplers, index, "sampler", where);
    const std::string place = label("sampler", index, sampler.name);
    texture.wrap_s = wrap_of(file_, place, sampler.wrapS);
    texture.wrap_t = wrap_of(file_, place, sampler.wrapT);
    const bool linear = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_LINEAR;
    texture.nearest = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
    if (sampler.magFilter != -1 && !linear && !texture.nearest)
        file_.fail(place, "magFilter {} is unknown; use 9728 or 9729", sampler.magFilter);
}

uint32_t TextureReader::place_of_uv_set(int set) {
    if (set < 0) file_.fail(where_, "texCoord {} is negative; repair it", set);
    auto& sets = material_.uv_sets;
    const auto known = std::ranges::find(sets, static_cast<uint32_t>(set));
    if (known != sets.end()) return static_cast<uint32_t>(known - sets.begin());
    if (sets.size() == 2)
        file_.fail(
            where_,
            "its textures use more than two sets of texture coordinates; bake them into "
            "two");
    sets.push_back(static_cast<uint32_t>(set));
    return static_cast<uint32_t>(sets.size() - 1);
}

void load_images(const GltfFile& file, Scene& scene, uint64_t most_texels) {
    std::vector<bool> used(scene.materials.size(), false);
    for (const Primitive& primitive : scene.primitives) used[primitive.material] = true;
    std::map<uint32_t, uint32_t> loaded;  // by the file's index
    uint64_t texels = 0;
    for (std::size_t m = 0; m < scene.materials.size(); ++m) {
        for (Texture& texture : scene.materials[m].textures) {
            if (!texture.image) continue;
            if (!used[m]) {
                texture.image.reset();
                continue;
            }
            const uint32_t index = *texture.image;
            const auto [entry, is_new] =
                loaded.try_emplace(index, static_cast<uint32_t>(scene.images.size()));
            texture.image = entry->second;
            if (!is_new) continue;
            const tinygltf::Image& source = file.model.images[index];
            const std::string where = label(
                "image", static_cast<int>(index), source.uri.empty() ? source.name : source.uri);
            const auto bytes = encoded_bytes(file, source, where);
            try {
                const ImageSize size = read_image_size(bytes);
                texels += uint64_t{size.width} * size.height;
                if (texels > most_texels)
                    throw Error(
                        "with it the scene's images have {} Mi texels, more than the {} Mi "
                        "allowed; shrink them or raise --max-texels",
                        texels >> 20U, most_texels >> 20U);
                scene.images.push_back(decode_image(bytes));
            } catch (const Error& error) {
                file.fail(where, "{}", error.what());
            }
        }
    }
}

}  // namespace wavepath
