#include "gltf/gltf_schema.h"

#include "gltf/gltf_file.h"
#include "gltf/gltf_members.h"
#include "gltf/json_member.h"

#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

namespace wavepath {
namespace {

using Json = nlohmann::json;

enum class Type { boolean, number, text, index, size, object };

struct Rule {
    std::string_view name;
    std::string_view kind;  // of an object, or the type's name
    Type type = Type::object;
    bool is_array = false;
    bool is_required = false;
    bool is_free = false;  // may be of another type
};

bool take_suffix(std::string_view& text, std::string_view suffix) {
    const bool has = text.ends_with(suffix);
    if (has) text.remove_suffix(suffix.size());
    return has;
}

Rule rule_of(const Member& member) {
    constexpr std::pair<std::string_view, Type> types[] = {
        {"boolean", Type::boolean}, {"number", Type::number}, {"text", Type::text},
        {"index", Type::index},     {"size", Type::size},
    };
    Rule rule{member.name, member.type};
    rule.is_free = take_suffix(rule.kind, "?");
    rule.is_required = take_suffix(rule.kind, "!");
    rule.is_array = take_suffix(rule.kind, "[]");
    for (const auto& [name, type] : types)
        if (rule.kind == name) rule.type = type;
    return rule;
}

// By the kind of object that has the members.
const std::vector<Rule>& rules_of(std::string_view kind) {
    static const auto all = [] {
        std::map<std::string_view, std::vector<Rule>> rules;
        for (const Member& member : members_read()) rules[member.of].push_back(rule_of(member));
        return rules;
    }();
    static const std::vector<Rule> none;
    const auto found = all.find(kind);
    return found == all.end() ? none : found->second;
}

const char* name_of(Type type) {
    switch (type) {
        case Type::boolean:
            return "true or false";
        case Type::number:
            return "a number";
        case Type::text:
            return "a text";
        case Type::index:
            return "an integer from 0 to 2^31";
        case Type::size:
            return "an integer from 0 on";
        default:
            return "an object";
    }
}

// As 1 where `value` is a 1.0.
void put_integer_right(Json& value) {
    constexpr double most = 0x1p53;  // beyond, a double is not one integer alone
    if (!value.is_number_float()) return;
    const double number = value.get<double>();
    if (number != std::floor(number) || std::abs(number) > most) return;
    if (number < 0)
        value = static_cast<std::int64_t>(number);
    else
        value = static_cast<std::uint64_t>(number);
}

bool is_integer_up_to(const Json& value, std::uint64_t most) {
    return value.is_number_unsigned() && value.get<std::uint64_t>() <= most;
}

bool has_type(const Json& value, Type type) {
    switch (type) {
        case Type::boolean:
            return value.is_boolean();
        case Type::number:
            return value.is_number();
        case Type::text:
            return value.is_string();
        case Type::index:
            return is_integer_up_to(value, 0x7FFFFFFF);
        case Type::size:
            return is_integer_up_to(value, std::numeric_limits<std::uint64_t>::max());
        default:
            return value.is_object();
    }
}

std::string shown(const Json& value) {
    if (value.is_structured()) return value.is_array() ? "an array" : "an object";
    constexpr std::size_t longest = 40;
    const std::string text = one_line(value.dump());
    return text.size() > longest ? "a long text" : text;
}

std::string judge_members(Json& object, std::string_view kind, const std::string& place);

std::string judge_value(Json& value, const Rule& rule, const std::string& place) {
    if (rule.type == Type::index || rule.type == Type::size) put_integer_right(value);
    if (!has_type(value, rule.type))
        return rule.is_free
                   ? ""
                   : fmt::format("{} is {}, not {}", place, shown(value), name_of(rule.type));
    return value.is_object() ? judge_members(value, rule.kind, place + ".") : "";
}

// The elements of the file are called by what they are, as in mesh 3 "lamp".
std::string judge_elements(Json& elements, const Rule& rule) {
    for (std::size_t i = 0; i < elements.size(); ++i) {
        const std::string element =
            label(rule.kind, static_cast<int>(i), json_text(elements[i], "name"));
        std::string found = elements[i].is_object()
                                ? judge_members(elements[i], rule.kind, element + ": ")
                                : judge_value(elements[i], rule, element);
        if (!found.empty()) return found;
    }
    return "";
}

std::string judge_member(Json& member, const Rule& rule, std::string_view of, std::string place) {
    if (!rule.is_array) return judge_value(member, rule, place);
    if (!member.is_array()) return fmt::format("{} is {}, not an array", place, shown(member));
    if (rule.type == Type::object && (of == "root" || of == "lights"))
        return judge_elements(member, rule);
    for (std::size_t i = 0; i < member.size(); ++i)
        if (std::string found = judge_value(member[i], rule, fmt::format("{}[{}]", place, i));
            !found.empty())
            return found;
    return "";
}

// `place` of the object, with what parts it from its members.
std::string judge_members(Json& object, std::string_view kind, const std::string& place) {
    for (const Rule& rule : rules_of(kind)) {
        const bool any_name = rule.name == "*";
        if (rule.is_required && !object.contains(rule.name))
            return fmt::format("{}{} is missing", place, rule.name);
        const auto first = any_name ? object.begin() : object.find(rule.name);
        const auto last = any_name || first == object.end() ? object.end() : std::next(first);
        for (auto member = first; member != last; ++member)
            if (std::string found =
                    judge_member(*member, rule, kind, place + one_line(member.key()));
                !found.empty())
                return found;
    }
    return "";
}

}  // namespace

std::string put_types_right(Json& root) {
    return root.is_object() ? judge_members(root, "root", "") : "the file is no JSON object";
}

}  // namespace wavepath
