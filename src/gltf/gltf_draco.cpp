#include "gltf/gltf_draco.h"

#include "gltf/gltf_accessor.h"

#include <draco/compression/decode.h>

#include <cstdint>
#include <cstring>

namespace wavepath {
namespace {

constexpr const char* extension_name = "KHR_draco_mesh_compression";

std::unique_ptr<draco::Mesh> decode(
    const GltfFile& file, std::span<const unsigned char> bytes, std::string_view where) {
    std::string reason;
    try {
        draco::DecoderBuffer buffer;
        buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        auto mesh = draco::Decoder().DecodeMeshFromBuffer(&buffer);
        if (mesh.ok()) return std::move(mesh).value();
        reason = mesh.status().error_msg_string();
    } catch (const std::exception& exception) {  // bad_alloc, length_error: sizes are the file's
        reason = exception.what();
    }
    file.fail(
        where, "its data do not decode ({}); the file is broken, export again", one_line(reason));
}

class PrimitiveDecoder {
  public:
    PrimitiveDecoder(
        GltfFile& file,
        tinygltf::Primitive& primitive,
        const tinygltf::Value& object,
        std::string where)
        : file_(file),
          primitive_(primitive),
          attributes_(object.Get("attributes")),
          where_(std::move(where)),
          mesh_(draco_mesh(object)) {}

    void replace() {
        for (const std::string& name : attributes_.Keys()) {
            const auto found = primitive_.attributes.find(name);
            if (found == primitive_.attributes.end())
                file_.fail(
                    where_, "compresses {}, which the primitive lacks; export again",
                    one_line(name));
            found->second = add_accessor(name, found->second);
        }
        primitive_.indices = add_indices();
        primitive_.mode = TINYGLTF_MODE_TRIANGLES;
    }

  private:
    std::unique_ptr<draco::Mesh> draco_mesh(const tinygltf::Value& object) const {
        if (!attributes_.IsObject()) file_.fail(where_, "has no attributes; export again");
        const int view = integer(file_, where_, object, "bufferView");
        return decode(file_, view_bytes(file_, view, where_), where_);
    }

    // As the primitive's own accessor says it, with the compressed values.
    int add_accessor(const std::string& name, int original) {
        tinygltf::Accessor accessor = file_.at(file_.model.accessors, original, "accessor", where_);
        const int id = integer(file_, where_, attributes_, name.c_str());
        const draco::PointAttribute* attribute =
            mesh_->GetAttributeByUniqueId(static_cast<std::uint32_t>(id));
        if (!attribute) file_.fail(where_, "its data hold no attribute {}; export again", id);
        switch (accessor.componentType) {
            case TINYGLTF_COMPONENT_TYPE_BYTE:
                return add_rows<std::int8_t>(accessor, *attribute);
            case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
                return add_rows<std::uint8_t>(accessor, *attribute);
            case TINYGLTF_COMPONENT_TYPE_SHORT:
                return add_rows<std::int16_t>(accessor, *attribute);
            case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
                return add_rows<std::uint16_t>(accessor, *attribute);
            case TINYGLTF_COMPONENT_TYPE_FLOAT:
                return add_rows<float>(accessor, *attribute);
            default:
                file_.fail(
                    where_, "{} has component type {}; export again", one_line(name),
                    accessor.componentType);
        }
    }

    template <typename T>
    int add_rows(tinygltf::Accessor accessor, const draco::PointAttribute& attribute) {
        const int width =
            tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
        if (width < 1 || width > 4) file_.fail(where_, "an attribute is no vector; export again");
        std::vector<T> rows(static_cast<std::size_t>(width) * mesh_->num_points());
        for (std::uint32_t point = 0; point < mesh_->num_points(); ++point)
            if (!attribute.ConvertValue(
                    attribute.mapped_index(draco::PointIndex(point)),
                    static_cast<std::int8_t>(width),
                    &rows[static_cast<std::size_t>(width) * point]))
                file_.fail(where_, "its data do not fit their accessor; export again");
        accessor.count = mesh_->num_points();
        return add(std::move(accessor), rows);
    }

    int add_indices() {
        std::vector<std::uint32_t> indices;
        indices.reserve(3 * std::size_t{mesh_->num_faces()});
        for (draco::FaceIndex face(0); face < mesh_->num_faces(); ++face)
            for (const draco::PointIndex& corner : mesh_->face(face))
                indices.push_back(corner.value());
        tinygltf::Accessor accessor;
        accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
        accessor.type = TINYGLTF_TYPE_SCALAR;
        accessor.count = indices.size();
        return add(std::move(accessor), indices);
    }

    // Adds `values` as buffer and view of `accessor`; returns the accessor's index.
    template <typename T>
    int add(tinygltf::Accessor&& accessor, const std::vector<T>& values) {
        tinygltf::Model& model = file_.model;
        tinygltf::Buffer& buffer = model.buffers.emplace_back();
        buffer.data.resize(sizeof(T) * values.size());
        std::memcpy(buffer.data.data(), values.data(), buffer.data.size());
        tinygltf::BufferView& view = model.bufferViews.emplace_back();
        view.buffer = static_cast<int>(model.buffers.size() - 1);
        view.byteLength = buffer.data.size();
        accessor.bufferView = static_cast<int>(model.bufferViews.size() - 1);
        accessor.byteOffset = 0;
        accessor.sparse = {};  // whose numbers tinygltf leaves without values
        model.accessors.push_back(std::move(accessor));
        return static_cast<int>(model.accessors.size() - 1);
    }

    GltfFile& file_;
    tinygltf::Primitive& primitive_;
    const tinygltf::Value& attributes_;
    std::string where_;
    std::unique_ptr<draco::Mesh> mesh_;
};

}  // namespace

void decode_draco(GltfFile& file) {
    for (std::size_t i = 0; i < file.model.meshes.size(); ++i) {
        tinygltf::Mesh& mesh = file.model.meshes[i];
        for (std::size_t k = 0; k < mesh.primitives.size(); ++k) {
            tinygltf::Primitive& primitive = mesh.primitives[k];
            const auto* extension = find_extension(primitive.extensions, extension_name);
            if (!extension) continue;
            PrimitiveDecoder(
                file, primitive, *extension,
                fmt::format(
                    "{}, primitive {}, {}", label("mesh", static_cast<int>(i), mesh.name), k,
                    extension_name))
                .replace();
        }
    }
}

}  // namespace wavepath
