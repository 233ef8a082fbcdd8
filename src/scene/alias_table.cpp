#include "scene/alias_table.h"

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
        table[i] = {1.0F, i, static_cast<float>(scaled[i] / static_cast<double>(n))};
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
    return table;  // rows left in either list differ from 1 by rounding alone
}

}  // namespace wavepath
