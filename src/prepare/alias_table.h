#pragma once

#include <cstdint>
#include <vector>

namespace wavepath {

struct AliasRow {
    float threshold = 1;  // below: this entry, else `alias`; a multiple of 2^-24
    uint32_t alias = 0;
    float pmf = 0;  // chance of the entry, its weight but for the rounding of thresholds
};

// Walker's alias method, built in O(n) [Vose 1991]. Weights are finite and >= 0; all zero means
// uniform.
std::vector<AliasRow> build_alias_table(const std::vector<double>& weights);

}  // namespace wavepath
