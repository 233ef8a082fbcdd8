// How commands write their JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace wavepath {

// null for what JSON has no number for: NaN and infinities.
nlohmann::ordered_json json_number(double value);

// On one line where `indent` is -1. Names of files and texts of drivers need not be UTF-8: what is
// not is replaced rather than refused.
std::string json_text(const nlohmann::ordered_json& json, int indent);

}  // namespace wavepath
