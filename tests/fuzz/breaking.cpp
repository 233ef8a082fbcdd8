#include "breaking.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <cstring>
#include <iterator>
#include <vector>

namespace wavepath {
namespace {

using Json = nlohmann::json;

constexpr std::size_t glb_header_size = 20;

// What files are broken with: around the limits of the types that sizes and indices have.
Json rare_value(Random& random) {
    static const std::vector<Json> values{
        -1,
        0,
        1,
        2,
        3,
        4,
        5,
        7,
        16,
        255,
        256,
        5120,
        5121,
        5123,
        5125,
        5126,
        65535,
        65536,
        (1 << 24) - 1,
        (1 << 24) + 1,
        2147483647,
        -2147483648LL,
        2147483648LL,
        4294967295LL,
        4294967296LL,
        9223372036854775807LL,
        18446744073709551615ULL,
        0.5,
        -0.0,
        1e-300,
        1e38,
        1e39,
        1e300,
        -1e300,
        1e-45,
        true,
        false,
        nullptr,
        "",
        "VEC3",
        "SCALAR",
        "MAT4",
        "BLEND",
        "data:,",
        "../../..",
        "\xF0\x9F\x99\x82",
        Json::array(),
        Json::object(),
        Json::array({1, 2, 3}),
        Json::array({nullptr}),
        Json::object({{"index", 0}})};
    return values[below(random, values.size())];
}

// Every element of the tree, the root first.
void list_elements(Json& element, std::vector<Json*>& elements) {
    elements.push_back(&element);
    if (element.is_structured())
        for (Json& child : element) list_elements(child, elements);
}

void break_json(Json& root, Random& random) {
    for (std::size_t changes = 1 + below(random, 3); changes > 0; --changes) {
        std::vector<Json*> elements;
        list_elements(root, elements);
        Json& element = *elements[below(random, elements.size())];
        const Json other = *elements[below(random, elements.size())];
        switch (below(random, 6)) {
            case 0:
                if (element.is_array() && !element.empty())
                    element.erase(below(random, element.size()));
                else if (element.is_object() && !element.empty())
                    element.erase(std::next(
                        element.begin(),
                        static_cast<std::ptrdiff_t>(below(random, element.size()))));
                break;
            case 1:
                if (element.is_array()) element.push_back(other);
                break;
            case 2:
                if (element.is_number_integer())  // unsigned: it may wrap
                    element = static_cast<std::int64_t>(
                        static_cast<std::uint64_t>(element.get<std::int64_t>()) + below(random, 9) -
                        4);
                break;
            case 3:
                element = other;
                break;
            default:
                if (!element.is_structured() || below(random, 20) == 0)
                    element = rare_value(random);
        }
    }
}

bool is_binary(const std::string& bytes) {
    return bytes.size() > glb_header_size && bytes.starts_with("glTF");
}

}  // namespace

std::size_t below(Random& random, std::size_t end) {
    return std::uniform_int_distribution<std::size_t>(0, end - 1)(random);
}

void break_bytes(std::string& bytes, Random& random) {
    for (std::size_t changes = 1 + below(random, 8); changes > 0 && !bytes.empty(); --changes) {
        const std::size_t at = below(random, bytes.size());
        switch (below(random, 5)) {
            case 0:
                bytes[at] = static_cast<char>(below(random, 256));
                break;
            case 1:
                bytes[at] = static_cast<char>(bytes[at] ^ 1 << below(random, 8));
                break;
            case 2:
                bytes.erase(at, 1 + below(random, 16));
                break;
            case 3:
                bytes.insert(at, bytes.substr(below(random, bytes.size()), 1 + below(random, 16)));
                break;
            default:
                if (below(random, 20) == 0) bytes.resize(at);
        }
    }
}

void break_json_of(std::string& bytes, Random& random) {
    auto size = static_cast<std::uint32_t>(bytes.size());
    const std::size_t start = is_binary(bytes) ? glb_header_size : 0;
    if (start > 0) std::memcpy(&size, &bytes[12], sizeof size);
    Json root = Json::parse(bytes.substr(start, size), nullptr, false);
    if (root.is_discarded()) return break_bytes(bytes, random);
    break_json(root, random);
    std::string json = root.dump(-1, ' ', false, Json::error_handler_t::replace);
    if (start == 0) {
        bytes = json;
        return;
    }
    json.resize((json.size() + 3) / 4 * 4, ' ');
    bytes.replace(start, size, json);
    const auto json_size = static_cast<std::uint32_t>(json.size());
    const auto file_size = static_cast<std::uint32_t>(bytes.size());
    std::memcpy(&bytes[8], &file_size, sizeof file_size);
    std::memcpy(&bytes[12], &json_size, sizeof json_size);
}

}  // namespace wavepath
