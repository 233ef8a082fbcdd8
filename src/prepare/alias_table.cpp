#include "prepare/alias_table.h"

#include <cmath>
#include <numeric>

namespace wavepath {

std::vector<AliasRow> build_alias_table(const std::vector<double>& weights) {
    const std::size_t n = weights.size();
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    std::vector<AliasRow> table(n);
    std::vector<double> scaled(n, 1.0);
    std::vector<uint32_t> small;
    std::vector<uint32_t> large;
    for (uint32_t i = 0; i < n; ++i) {
        if (sum > 0) scaled[i] = weights[i] / sum * static_cast<double>(n);
        table[i] = {1.0F, i, 0.0F};
        (scaled[i] < 1 ? small : large).push_back(i);
    }
    while (!small.empty() && !large.empty()) {
        const uint32_t poor = small.back();
        const uint32_t rich = large.back();
        small.pop_back();
        table[poor].threshold = static_cast<float>(scaled[poor]);
        table[poor].alias = rich;
        scaled[rich] -= 1 - scaled[poor];
        if (scaled[rich] < 1) {
            large.pop_back();
            small.push_back(rich);
        }
    }
    // rows left in either list differ from 1 by rounding alone

    // The device compares 24 random bits with the threshold. Probabilities are those of what it
    // does, or a light of a millionth of the weight would be off by per cents.
    std::vector<double> chances(n, 0.0);
    for (uint32_t i = 0; i < n; ++i) {
        const double kept = std::ceil(table[i].threshold * 0x1p24) * 0x1p-24;
        table[i].threshold = static_cast<float>(kept);
        chances[i] += kept;
        chances[table[i].alias] += 1 - kept;
    }
    for (uint32_t i = 0; i < n; ++i)
        table[i].pmf = static_cast<float>(chances[i] / static_cast<double>(n));
    return table;
}

}  // namespace wavepath
