// JSON that nobody has checked yet.
#pragma once

#include <nlohmann/json.hpp>

namespace wavepath {

// Member `key` of `object`, or null.
inline const nlohmann::json& json_member(const nlohmann::json& object, const char* key) {
    static const nlohmann::json null;
    const auto found = object.is_object() ? object.find(key) : object.end();
    return found == object.end() ? null : *found;
}

}  // namespace wavepath
