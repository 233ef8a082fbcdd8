#include "gltf/gltf_data.h"

#include "gltf/json_member.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <fstream>

namespace wavepath {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using Bytes = std::vector<unsigned char>;

// %20 is a space [RFC 3986, section 2.1]; what is no code stays as it is.
std::string percent_decoded(std::string_view text) {
    std::string decoded;
    for (std::size_t i = 0; i < text.size(); ++i) {
        unsigned char code = 0;
        const char* const digits = text.data() + i + 1;
        const bool is_code = text[i] == '%' && i + 2 < text.size() &&
                             std::from_chars(digits, digits + 2, code, 16).ptr == digits + 2;
        decoded += is_code ? static_cast<char>(code) : text[i];
        if (is_code) i += 2;
    }
    return decoded;
}

bool is_data_uri(std::string_view uri) {
    return uri.starts_with("data:");
}

// Of any media type or none [RFC 2397]; nothing where it is not base64. tinygltf decodes, but takes
// URIs of types that it does not know for names of files.
std::optional<Bytes> decode_data_uri(std::string_view uri) {
    const std::size_t comma = uri.find(',');
    if (comma == uri.npos || !uri.substr(0, comma).ends_with(";base64")) return std::nullopt;
    std::string text = percent_decoded(uri.substr(comma + 1));
    const std::size_t digits = std::min(text.find('='), text.size());
    const std::size_t size = digits * 3 / 4;
    Bytes bytes;
    std::string type;
    if (size == 0) return bytes;
    if (!tinygltf::DecodeDataURI(
            &bytes, type, "data:application/octet-stream;base64," + text, 0, false) ||
        bytes.size() != size)  // it stops at what is no digit
        return std::nullopt;
    return bytes;
}

class DataReader {
  public:
    DataReader(const fs::path& folder, GltfFile& file) : folder_(folder), file_(file) {}

    // The bytes behind `uri`; where there are none, an empty vector and in `why` the reason.
    Bytes read(const std::string& uri, std::string& why) {
        if (is_data_uri(uri)) {
            auto bytes = decode_data_uri(uri);
            if (!bytes) why = "its data URI is not base64; export again";
            return std::move(bytes).value_or(Bytes{});
        }
        // joined as text: an absolute path leads out of no folder
        const fs::path path = folder_.string() + "/" + percent_decoded(uri);
        std::error_code status;
        if (!fs::is_regular_file(path, status)) {
            why = fmt::format("{} is not there; put it beside the scene", one_line(uri));
            return {};
        }
        file_.files.push_back(path);
        Bytes bytes(static_cast<std::size_t>(fs::file_size(path, status)));
        std::ifstream stream(path, std::ios::binary);
        if (!stream.read(
                reinterpret_cast<char*>(bytes.data()),
                static_cast<std::streamsize>(bytes.size()))) {
            why = fmt::format("{} cannot be read; check its permissions", one_line(uri));
            return {};
        }
        return bytes;
    }

  private:
    const fs::path& folder_;
    GltfFile& file_;
};

// A chunk is padded, and a file may hold more than the buffer: its byteLength counts.
void cut_to_length(Bytes& data, std::size_t length, std::string& why) {
    if (!why.empty()) return;
    if (data.size() < length) {
        why = fmt::format(
            "has {} bytes, but byteLength {}; the file is cut short or wrong, export again",
            data.size(), length);
        data.clear();
    } else {
        data.resize(length);
    }
}

}  // namespace

void take_data(
    Json& root,
    const fs::path& folder,
    std::optional<std::span<const unsigned char>> chunk,
    GltfFile& file) {
    DataReader reader(folder, file);
    for (const Json& source : json_member(root, "buffers")) {
        tinygltf::Buffer& buffer = file.model.buffers.emplace_back();
        std::string& why = file.missing_data.emplace_back();
        buffer.name = json_text(source, "name");
        if (source.contains("uri"))
            buffer.data = reader.read(json_text(source, "uri"), why);
        else if (chunk && file.model.buffers.size() == 1)
            buffer.data.assign(chunk->begin(), chunk->end());
        else
            why = "has no uri, and so no data; export again";
        cut_to_length(buffer.data, source["byteLength"].get<std::size_t>(), why);
    }
    for (const Json& source : json_member(root, "images")) {
        const auto index = static_cast<int>(file.model.images.size());
        tinygltf::Image& image = file.model.images.emplace_back();
        image.name = json_text(source, "name");
        if (source.contains("bufferView") && source.contains("uri"))
            file.fail(
                label("image", index, image.name),
                "has both a bufferView and a uri; remove one of them");
        if (const Json& view = json_member(source, "bufferView"); view.is_number())
            image.bufferView = view.get<int>();
        const std::string uri = json_text(source, "uri");
        if (!is_data_uri(uri)) image.uri = uri;
        std::string why;
        if (image.bufferView < 0 && !uri.empty()) image.image = reader.read(uri, why);
    }
    root.erase("buffers");
    root.erase("images");
}

}  // namespace wavepath
