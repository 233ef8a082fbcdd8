#pragma once

#include "gltf/gltf_loader.h"
#include "support/temporary_folder.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

namespace wavepath {

// Puts small glTF files together in memory. `root` is the JSON as it stands, to be broken at will.
class GltfBuilder {
  public:
    using Json = nlohmann::json;

    Json root = {
        {"asset", {{"version", "2.0"}}}, {"scene", 0}, {"scenes", {{{"nodes", Json::array()}}}}};

    // A buffer view over `values`; returns its index. Each starts at a multiple of 4.
    template <typename T>
    int view(const std::vector<T>& values, int stride = 0) {
        const std::size_t offset = bytes_.size();
        const std::size_t size = values.size() * sizeof(T);
        bytes_.resize(offset + size);
        std::memcpy(bytes_.data() + offset, values.data(), size);
        bytes_.resize((bytes_.size() + 3) / 4 * 4);
        Json view = {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", size}};
        if (stride > 0) view["byteStride"] = stride;
        return add("bufferViews", view);
    }

    // An accessor over a new, tightly packed view; `more` adds or replaces properties.
    template <typename T>
    int accessor(
        const std::string& type, const std::vector<T>& values, const Json& more = Json::object()) {
        const std::size_t width =
            type == "SCALAR" ? 1 : static_cast<std::size_t>(type.back() - '0');
        Json accessor = {
            {"bufferView", view(values)},
            {"componentType", component_type<T>()},
            {"count", values.size() / width},
            {"type", type}};
        accessor.update(more);
        return add("accessors", accessor);
    }

    // A node of the default scene with a mesh of one primitive; returns the node's index.
    int object(const Json& primitive) {
        return node({{"mesh", add("meshes", {{"primitives", {primitive}}})}});
    }

    // The triangle (0 0 0) (1 0 0) (0 1 0) as an object.
    int triangle() { return object({{"attributes", {{"POSITION", triangle_positions()}}}}); }

    int triangle_positions() { return accessor<float>("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0}); }

    int node(const Json& node) {
        const int index = add("nodes", node);
        root["scenes"][0]["nodes"].push_back(index);
        return index;
    }

    // Appends to the array `key` of the root; returns the index.
    int add(const char* key, const Json& element) {
        root[key].push_back(element);
        return static_cast<int>(root[key].size()) - 1;
    }

    // The whole file as .gltf, its buffer a data URI.
    std::string text() const {
        Json file = root;
        if (!file.contains("buffers") && !bytes_.empty())
            file["buffers"] = {
                {{"byteLength", bytes_.size()},
                 {"uri", "data:application/octet-stream;base64," + base64(bytes_)}}};
        return file.dump();
    }

    // The whole file as .glb.
    std::string binary() const {
        Json file = root;
        file["buffers"] = {{{"byteLength", bytes_.size()}}};
        std::string json = file.dump();
        json.resize((json.size() + 3) / 4 * 4, ' ');
        return "glTF" + word(2) + word(28 + json.size() + bytes_.size()) + word(json.size()) +
               "JSON" + json + word(bytes_.size()) + std::string("BIN\0", 4) + bytes_;
    }

  private:
    template <typename T>
    static int component_type() {
        if (std::is_same_v<T, std::int8_t>) return 5120;
        if (std::is_same_v<T, std::uint8_t>) return 5121;
        if (std::is_same_v<T, std::int16_t>) return 5122;
        if (std::is_same_v<T, std::uint16_t>) return 5123;
        if (std::is_same_v<T, std::uint32_t>) return 5125;
        if (std::is_same_v<T, double>) return 5130;
        static_assert(std::is_arithmetic_v<T>);
        return 5126;
    }

    static std::string word(std::size_t value) {
        const auto word = static_cast<std::uint32_t>(value);
        return {reinterpret_cast<const char*>(&word), sizeof word};
    }

    // `bytes` fills whole words, so that at most two '=' end the text.
    static std::string base64(const std::string& bytes) {
        constexpr char digits[] =
            "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        std::string text;
        for (std::size_t i = 0; i < bytes.size(); i += 3) {
            std::uint32_t block = 0;
            for (std::size_t k = i; k < i + 3; ++k)
                block = block << 8 | (k < bytes.size() ? static_cast<std::uint8_t>(bytes[k]) : 0U);
            for (std::size_t k = 0; k < 4; ++k)
                text += i + k > bytes.size() ? '=' : digits[block >> (18 - 6 * k) & 63];
        }
        return text;
    }

    std::string bytes_;
};

inline Scene load(const GltfBuilder& builder) {
    const TemporaryFolder folder;
    return load_gltf(folder.write("scene.gltf", builder.text()));
}

// The message load() fails with, "" where it does not.
inline std::string load_error(const GltfBuilder& builder) {
    return error_of([&] { load(builder); });
}

}  // namespace wavepath
