#include "gltf/gltf_meshopt.h"

#include "gltf/gltf_accessor.h"

#include <meshoptimizer.h>

#include <span>

namespace wavepath {
namespace {

constexpr const char* extension_name = "EXT_meshopt_compression";

// No codec packs more than that many bytes into one: 256 equal vertices of 4 bytes take 4 bytes for
// each of theirs. Hence the size of the file bounds memory.
constexpr std::size_t most_packed = 64;

class ViewDecoder {
  public:
    ViewDecoder(const GltfFile& file, const tinygltf::Value& object, std::string where)
        : file_(file),
          where_(std::move(where)),
          mode_(text(object, "mode", "")),
          filter_(text(object, "filter", "NONE")),
          stride_(size(object, "byteStride")),
          count_(size(object, "count")),
          encoded_(buffer_bytes(
              file,
              integer(file, where_, object, "buffer"),
              size(object, "byteOffset", 0),
              size(object, "byteLength"),
              where_)) {}

    bool holds_vertices() const { return mode_ == "ATTRIBUTES"; }
    std::size_t stride() const { return stride_; }

    std::vector<unsigned char> decode() const {
        check_shape();
        if (count_ * stride_ > most_packed * encoded_.size())
            file_.fail(
                where_, "{} bytes cannot hold {} rows of {}; repair the count or export again",
                encoded_.size(), count_, stride_);
        std::vector<unsigned char> data(count_ * stride_);
        if (unpack(data.data()) != 0)
            file_.fail(where_, "its data do not decode; the file is broken, export again");
        if (filter_ == "OCTAHEDRAL") meshopt_decodeFilterOct(data.data(), count_, stride_);
        if (filter_ == "QUATERNION") meshopt_decodeFilterQuat(data.data(), count_, stride_);
        if (filter_ == "EXPONENTIAL") meshopt_decodeFilterExp(data.data(), count_, stride_);
        return data;
    }

  private:
    std::string text(const tinygltf::Value& object, const char* key, const char* missing) const {
        if (!object.Has(key)) return missing;
        if (!object.Get(key).IsString())
            file_.fail(where_, "{} is no text; repair it or export again", key);
        return object.Get(key).Get<std::string>();
    }

    std::size_t size(
        const tinygltf::Value& object, const char* key, std::optional<int> missing = {}) const {
        return static_cast<std::size_t>(integer(file_, where_, object, key, missing));
    }

    // meshoptimizer asserts what the extension demands.
    void check_shape() const {
        const bool indices = mode_ == "TRIANGLES" || mode_ == "INDICES";
        if (!holds_vertices() && !indices)
            file_.fail(
                where_, "mode \"{}\" is unknown; export with ATTRIBUTES, TRIANGLES or INDICES",
                one_line(mode_));
        const bool stride_fits = indices ? stride_ == 2 || stride_ == 4
                                         : stride_ > 0 && stride_ <= 256 && stride_ % 4 == 0;
        if (!stride_fits || (mode_ == "TRIANGLES" && count_ % 3 != 0))
            file_.fail(
                where_, "mode {} does not allow {} rows of {} bytes; export again", mode_, count_,
                stride_);
        const bool filter_fits =
            filter_ == "NONE" ||
            (holds_vertices() &&
             ((filter_ == "OCTAHEDRAL" && (stride_ == 4 || stride_ == 8)) ||
              (filter_ == "QUATERNION" && stride_ == 8) || filter_ == "EXPONENTIAL"));
        if (!filter_fits)
            file_.fail(
                where_, "filter \"{}\" is unknown for mode {} and rows of {} bytes; export again",
                one_line(filter_), mode_, stride_);
    }

    int unpack(unsigned char* to) const {
        if (holds_vertices())
            return meshopt_decodeVertexBuffer(
                to, count_, stride_, encoded_.data(), encoded_.size());
        if (mode_ == "TRIANGLES")
            return meshopt_decodeIndexBuffer(to, count_, stride_, encoded_.data(), encoded_.size());
        return meshopt_decodeIndexSequence(to, count_, stride_, encoded_.data(), encoded_.size());
    }

    const GltfFile& file_;
    std::string where_;
    std::string mode_;
    std::string filter_;
    std::size_t stride_;
    std::size_t count_;
    std::span<const unsigned char> encoded_;
};

}  // namespace

void decode_meshopt(GltfFile& file) {
    std::vector<tinygltf::Buffer> decoded;  // added at the end: decoders look at the others
    for (std::size_t i = 0; i < file.model.bufferViews.size(); ++i) {
        tinygltf::BufferView& view = file.model.bufferViews[i];
        const auto* extension = find_extension(view.extensions, extension_name);
        if (!extension) continue;
        const ViewDecoder decoder(
            file, *extension,
            fmt::format(
                "{}, {}", label("bufferView", static_cast<int>(i), view.name), extension_name));
        decoded.emplace_back().data = decoder.decode();
        view.buffer = static_cast<int>(file.model.buffers.size() + decoded.size() - 1);
        view.byteOffset = 0;
        view.byteLength = decoded.back().data.size();
        if (decoder.holds_vertices()) view.byteStride = decoder.stride();
    }
    std::ranges::move(decoded, std::back_inserter(file.model.buffers));
}

}  // namespace wavepath
