#include "gltf/gltf_ignored.h"

#include <fmt/format.h>

#include <algorithm>

namespace wavepath {

void Ignored::add(const std::string& what, const std::string& instead, std::size_t count) {
    if (count == 0) return;
    const auto known = std::ranges::find(kinds_, what, &Kind::what);
    if (known == kinds_.end())
        kinds_.push_back({what, instead, count});
    else
        known->count += count;
}

std::vector<std::string> Ignored::lines() const {
    std::vector<std::string> lines;
    for (const Kind& kind : kinds_)
        lines.push_back(fmt::format("{} ({}): {}", kind.what, kind.count, kind.instead));
    return lines;
}

}  // namespace wavepath
