#include "support/probe.h"

#include <gtest/gtest.h>

namespace wavepath {
namespace {

// Exact: every set of eight lanes.
TEST(Simd, MasksAndPacksLanes) {
    const Probe probe({"geometry/simd.cl"}, R"(
kernel void lanes(const uint count, global int* out) {
    const uint set = (uint)get_global_id(0);
    if (set >= count) return;
    const int8 bit = (int8)(1, 2, 4, 8, 16, 32, 64, 128);
    out[9 * set] = (int)lane_mask(((int8)((int)set) & bit) != 0);
    vstore8(pack_lanes((int8)(10, 11, 12, 13, 14, 15, 16, 17), set), 0, out + 9 * set + 1);
}
)");
    const auto out = probe.run<cl_int>("lanes", 256, std::size_t{9} * 256);
    for (std::size_t set = 0; set < 256; ++set) {
        EXPECT_EQ(out[9 * set], static_cast<int>(set));
        std::size_t packed = 0;
        for (std::size_t lane = 0; lane < 8; ++lane) {
            if ((set >> lane & 1U) == 0) continue;
            EXPECT_EQ(out[9 * set + 1 + packed], static_cast<int>(10 + lane)) << set;
            ++packed;
        }
    }
}

}  // namespace
}  // namespace wavepath
