#include "gltf/gltf_accessor.h"

#include "gltf/gltf_component.h"

#include <algorithm>
#include <cmath>

namespace wavepath {
namespace {

// Equally spaced rows inside a buffer view, already checked to lie there.
struct Rows {
    const unsigned char* first = nullptr;
    std::size_t stride = 0;  // [byte]

    const unsigned char* operator[](std::size_t row) const { return first + row * stride; }
};

// `count` > 0 rows of `row_size` bytes from `byte_offset` on. Every comparison is written so that
// no sum can overflow.
Rows find_rows(
    const GltfFile& file,
    int view_index,
    std::size_t byte_offset,
    std::size_t count,
    std::size_t row_size,
    std::string_view where) {
    const auto& view = file.at(file.model.bufferViews, view_index, "bufferView", where);
    const std::span<const unsigned char> bytes = view_bytes(file, view_index, where);
    const std::size_t stride = view.byteStride == 0 ? row_size : view.byteStride;
    if (stride < row_size)
        file.fail(
            label("bufferView", view_index, view.name),
            "byteStride {} is less than the {} bytes of a row; repair it or export again", stride,
            row_size);
    if (byte_offset > view.byteLength || row_size > view.byteLength - byte_offset ||
        count - 1 > (view.byteLength - byte_offset - row_size) / stride)
        file.fail(
            where,
            "{} rows from byte {} end after bufferView {} of {} bytes; repair the count or export "
            "again",
            count, byte_offset, view_index, view.byteLength);
    return {bytes.data() + byte_offset, stride};
}

// Hands `store(row, bytes)` the rows that the sparse part of `accessor` replaces.
template <typename Store>
void for_each_sparse_row(
    const GltfFile& file,
    const tinygltf::Accessor& accessor,
    std::size_t row_size,
    std::string_view where,
    const Store& store) {
    const auto& sparse = accessor.sparse;
    if (!sparse.isSparse) return;
    if (sparse.count < 1 || static_cast<std::size_t>(sparse.count) > accessor.count)
        file.fail(
            where, "sparse count {} is not in 1 .. {}; repair it or export again", sparse.count,
            accessor.count);
    const auto& indices = sparse.indices;
    const auto& values = sparse.values;
    if (!is_index_component(indices.componentType))
        file.fail(
            where, "sparse indices have component type {}; export as UNSIGNED_BYTE, _SHORT or _INT",
            indices.componentType);
    const auto replaced = static_cast<std::size_t>(sparse.count);
    const Rows targets = find_rows(
        file, indices.bufferView, static_cast<std::size_t>(indices.byteOffset), replaced,
        component_size(indices.componentType), where);
    const Rows rows = find_rows(
        file, values.bufferView, static_cast<std::size_t>(values.byteOffset), replaced, row_size,
        where);
    std::uint32_t next = 0;
    for (std::size_t i = 0; i < replaced; ++i) {
        const std::uint32_t target = load_index(targets[i], indices.componentType);
        if (target < next)
            file.fail(
                where, "sparse index {} does not follow the one before it in order; export again",
                target);
        next = target + 1;
        if (target >= accessor.count)
            file.fail(
                where, "sparse index {} is not below the count {}; repair it or export again",
                target, accessor.count);
        store(target, rows[i]);
    }
}

// Rows that no buffer view holds are zero, and their number is not bounded by the file's size.
void check_unbacked_count(const GltfFile& file, std::size_t count, std::string_view where) {
    constexpr std::size_t most = std::size_t{1} << 24;
    if (count > most)
        file.fail(
            where, "{} rows without a bufferView are more than the {} allowed; export again", count,
            most);
}

// All rows of `accessor`, `width` values each: `decode(bytes, values)` reads one.
template <typename T, typename Decode>
std::vector<T> read_rows(
    const GltfFile& file,
    const tinygltf::Accessor& accessor,
    std::size_t row_size,
    std::size_t width,
    std::string_view where,
    const Decode& decode) {
    if (accessor.count == 0) file.fail(where, "holds no rows; remove it or export again");
    Rows rows;
    if (accessor.bufferView < 0)
        check_unbacked_count(file, accessor.count, where);
    else
        rows = find_rows(
            file, accessor.bufferView, accessor.byteOffset, accessor.count, row_size, where);

    std::vector<T> values(width * accessor.count);  // the count is checked by now
    const auto store = [&](std::size_t row, const unsigned char* bytes) {
        decode(bytes, &values[width * row]);
    };
    if (accessor.bufferView >= 0)
        for (std::size_t row = 0; row < accessor.count; ++row) store(row, rows[row]);
    for_each_sparse_row(file, accessor, row_size, where, store);
    return values;
}

}  // namespace

std::span<const unsigned char> buffer_bytes(
    const GltfFile& file,
    int buffer,
    std::size_t offset,
    std::size_t length,
    std::string_view where) {
    const tinygltf::Buffer& source = file.at(file.model.buffers, buffer, "buffer", where);
    const auto& data = source.data;
    const auto index = static_cast<std::size_t>(buffer);
    if (index < file.missing_data.size() && !file.missing_data[index].empty())
        file.fail(label("buffer", buffer, source.name), "{}", file.missing_data[index]);
    if (offset > data.size() || length > data.size() - offset)
        file.fail(
            where,
            "ends after its buffer of {} bytes; the file is cut short or wrong, export again",
            data.size());
    return {data.data() + offset, length};
}

std::span<const unsigned char> view_bytes(const GltfFile& file, int index, std::string_view where) {
    const auto& view = file.at(file.model.bufferViews, index, "bufferView", where);
    return buffer_bytes(
        file, view.buffer, view.byteOffset, view.byteLength, label("bufferView", index, view.name));
}

std::vector<float> read_vectors(
    const GltfFile& file, int accessor_index, std::size_t width, std::string_view where) {
    const auto& accessor = file.at(file.model.accessors, accessor_index, "accessor", where);
    const std::size_t components = component_count(accessor.type);
    if (components < width || (width <= 4 && components > 4))
        file.fail(
            where, "accessor {} does not hold {} numbers a row; export again", accessor_index,
            width);
    if (!is_vertex_component(accessor.componentType))
        file.fail(
            where,
            "accessor {} has component type {}; export as FLOAT, or as (UNSIGNED_)BYTE or _SHORT",
            accessor_index, accessor.componentType);

    const std::size_t size = component_size(accessor.componentType);
    std::vector<float> values = read_rows<float>(
        file, accessor, size * components, width, where,
        [&](const unsigned char* bytes, float* row) {
            for (std::size_t i = 0; i < width; ++i)
                row[i] = load_float(bytes + i * size, accessor.componentType, accessor.normalized);
        });

    const auto broken =
        std::ranges::find_if_not(values, [](float value) { return std::isfinite(value); });
    if (broken != values.end())
        file.fail(
            where, "row {} is not finite; repair the mesh and export again",
            static_cast<std::size_t>(broken - values.begin()) / width);
    return values;
}

std::optional<std::vector<float>> read_attribute(
    const GltfFile& file,
    const tinygltf::Primitive& source,
    const std::string& name,
    std::size_t width,
    std::optional<std::size_t> vertex_count,
    std::string_view where) {
    const auto found = source.attributes.find(name);
    if (found == source.attributes.end()) return std::nullopt;
    const std::string place = fmt::format("{}, {}", where, name);
    std::vector<float> values = read_vectors(file, found->second, width, place);
    if (vertex_count && values.size() != width * *vertex_count)
        file.fail(
            place, "has {} rows, POSITION has {}; repair the mesh and export again",
            values.size() / width, *vertex_count);
    return values;
}

std::vector<std::uint32_t> read_indices(
    const GltfFile& file, int accessor_index, std::size_t vertex_count, std::string_view where) {
    const auto& accessor = file.at(file.model.accessors, accessor_index, "accessor", where);
    if (accessor.type != TINYGLTF_TYPE_SCALAR || !is_index_component(accessor.componentType))
        file.fail(
            where, "accessor {} is no SCALAR of UNSIGNED_BYTE, _SHORT or _INT; export again",
            accessor_index);

    std::vector<std::uint32_t> indices = read_rows<std::uint32_t>(
        file, accessor, component_size(accessor.componentType), 1, where,
        [&](const unsigned char* bytes, std::uint32_t* index) {
            *index = load_index(bytes, accessor.componentType);
        });

    const std::uint32_t restart = restart_value(accessor.componentType);
    for (std::size_t i = 0; i < indices.size(); ++i) {
        if (indices[i] == restart)
            file.fail(where, "index {} is the primitive restart value; split the primitive", i);
        if (indices[i] >= vertex_count)
            file.fail(
                where,
                "index {} is {}, but there are {} vertices; repair the mesh and export again", i,
                indices[i], vertex_count);
    }
    return indices;
}

}  // namespace wavepath
