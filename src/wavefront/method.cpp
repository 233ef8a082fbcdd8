#include "wavefront/method.h"

#include "error.h"
#include "shared/queues.h"

#include <algorithm>
#include <charconv>
#include <string_view>

namespace wavepath {

namespace {

template <typename T>
bool parse_number(std::string_view text, T& value) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc{} && end == text.data() + text.size();
}

}  // namespace

const std::vector<Method>& methods() {
    static const std::vector<Method> all{
        {"path", false, false, false, false, LightChoice::area},
        {"direct", true, false, false, false, LightChoice::area},
        {"bsdf", false, true, false, false, LightChoice::area},
        {"direct-bsdf", true, true, false, false, LightChoice::area},
        {"mis", true, true, true, true, LightChoice::power},
    };
    return all;
}

const Method& method_named(const std::string& name) {
    const auto found = std::ranges::find(methods(), name, &Method::name);
    if (found == methods().end()) throw Error("there is no method {}", name);
    return *found;
}

const std::vector<std::string>& distance_names() {
    static const std::vector<std::string> names{
        "exponential", "uniform", "truncated", "equiangular", "mis"};
    return names;
}

Distances distances_named(const std::string& name) {
    const auto found = std::ranges::find(distance_names(), name);
    if (found == distance_names().end()) throw Error("there is no choice of distances {}", name);
    return static_cast<Distances>(found - distance_names().begin());
}

std::string name_of(Distances distances) {
    return distance_names()[static_cast<std::size_t>(distances)];
}

std::string Termination::text() const {
    switch (kind) {
        case TerminationKind::zero:
            return "zero";
        case TerminationKind::depth:
            return fmt::format("depth:{}", depth);
        case TerminationKind::roulette:
            return "roulette";
        case TerminationKind::roulette_constant:
            return fmt::format("roulette:{}", survival);
    }
    return {};
}

std::string Termination::bias() const {
    if (kind != TerminationKind::depth) return {};
    return fmt::format("biased: light of more than {} scatterings is missing", depth);
}

Termination parse_termination(const std::string& text) {
    Termination t;
    if (text == "zero") {
        t.kind = TerminationKind::zero;
    } else if (text == "roulette") {
        t.kind = TerminationKind::roulette;
    } else if (
        text.starts_with("depth:") && parse_number(std::string_view(text).substr(6), t.depth) &&
        t.depth < MAX_SCATTERINGS) {
        t.kind = TerminationKind::depth;
    } else if (
        text.starts_with("roulette:") &&
        parse_number(std::string_view(text).substr(9), t.survival) && t.survival > 0 &&
        t.survival <= 1) {
        t.kind = TerminationKind::roulette_constant;
    } else {
        throw Error(
            "--termination {}: use zero, depth:D (0 <= D < {}), roulette, or roulette:q (0 < q <= "
            "1)",
            text, MAX_SCATTERINGS);
    }
    return t;
}

Splits parse_splits(const std::string& text) {
    constexpr uint32_t most = 4096;
    std::vector<uint32_t> numbers;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        uint32_t value = 0;
        const bool number = parse_number(std::string_view(text).substr(begin, end - begin), value);
        numbers.push_back(number ? value : 0);
        begin = end + 1;
    }
    if (numbers.size() == 2) numbers.push_back(1);
    const auto in_range = [](uint32_t value) { return value >= 1 && value <= most; };
    if (numbers.size() != 3 || !std::ranges::all_of(numbers, in_range))
        throw Error(
            "--splits {}: use N,M or N,M,S: N stops on a segment, M directions from each, S from a "
            "surface point, each from 1 to {}",
            text, most);
    return {numbers[0], numbers[1], numbers[2]};
}

}  // namespace wavepath
