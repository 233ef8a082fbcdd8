#include "gltf/gltf_component.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cstring>
#include <limits>

namespace wavepath {

namespace {

template <typename T>
T load(const unsigned char* bytes) {
    T value;  // the file need not be aligned
    std::memcpy(&value, bytes, sizeof value);
    return value;
}

// The most negative integer is clamped to -1 [KHR_mesh_quantization].
template <typename T>
float load_number(const unsigned char* bytes, bool normalized) {
    const auto value = static_cast<float>(load<T>(bytes));
    return normalized ? std::max(value / static_cast<float>(std::numeric_limits<T>::max()), -1.0F)
                      : value;
}

}  // namespace

float load_float(const unsigned char* bytes, int component_type, bool normalized) {
    switch (component_type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return load_number<std::int8_t>(bytes, normalized);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return load_number<std::uint8_t>(bytes, normalized);
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return load_number<std::int16_t>(bytes, normalized);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return load_number<std::uint16_t>(bytes, normalized);
        default:
            return load<float>(bytes);
    }
}

bool is_vertex_component(int type) {
    return (type >= TINYGLTF_COMPONENT_TYPE_BYTE &&
            type <= TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT) ||
           type == TINYGLTF_COMPONENT_TYPE_FLOAT;
}

std::size_t component_count(int type) {
    switch (type) {
        case TINYGLTF_TYPE_SCALAR:
            return 1;
        case TINYGLTF_TYPE_VEC2:
            return 2;
        case TINYGLTF_TYPE_VEC3:
            return 3;
        case TINYGLTF_TYPE_VEC4:
            return 4;
        case TINYGLTF_TYPE_MAT4:
            return 16;
        default:
            return 0;
    }
}

std::uint32_t load_index(const unsigned char* bytes, int component_type) {
    switch (component_type) {
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return load<std::uint8_t>(bytes);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return load<std::uint16_t>(bytes);
        default:
            return load<std::uint32_t>(bytes);
    }
}

bool is_index_component(int type) {
    return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
           type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
           type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

std::uint32_t restart_value(int component_type) {
    switch (component_type) {
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return 0xFF;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return 0xFFFF;
        default:
            return 0xFFFFFFFF;
    }
}

std::size_t component_size(int type) {
    return static_cast<std::size_t>(
        tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(type)));
}

}  // namespace wavepath
