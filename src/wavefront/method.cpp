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
        {"path", false, false, false, true, LightChoice::area},
        {"direct", true, false, false, true, LightChoice::area},
        {"bsdf", false, true, false, true, LightChoice::area},
        {"direct-bsdf", true, true, false, true, LightChoice::area},
        {"mis", true, true, true, true, LightChoice::power},
    };
    return all;
}

const Method& method_named(const std::string& name) {
    const auto found = std::ranges::find(methods(), name, &Method::name);
    if (found == methods().end())
        throw Error(
            "--method {}: no such method; choose path, direct, bsdf, direct-bsdf or mis", name);
    return *found;
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

uint32_t parse_splits(const std::string& text) {
    uint32_t splits = 0;
    if (text.starts_with("1,1,") && parse_number(std::string_view(text).substr(4), splits) &&
        splits >= 1 && splits <= 4096)
        return splits;
    throw Error(
        "--splits {}: use 1,1,S with S directions from a surface point (1 <= S <= 4096)", text);
}

}  // namespace wavepath
