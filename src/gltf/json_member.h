// JSON that nobody has checked yet.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace wavepath {

// Member `key` of `object`, or null.
inline const nlohmann::json& json_member(const nlohmann::json& object, const char* key) {
    static const nlohmann::json null;
    const auto found = object.is_object() ? object.find(key) : object.end();
    return found == object.end() ? null : *found;
}

// The text `key` of `object`, or "".
inline std::string json_text(const nlohmann::json& object, const char* key) {
    const nlohmann::json& member = json_member(object, key);
    return member.is_string() ? member.get<std::string>() : "";
}

}  // namespace wavepath
