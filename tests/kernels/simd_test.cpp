#include "support/probe.h"

#include <gtest/gtest.h>

#include <bit>

namespace wavepath {
namespace {

constexpr const char* text = R"(
kernel void lanes(const uint count, global int* out) {
    const uint set = (uint)get_global_id(0);
    if (set >= count) return;
    const int8 bit = (int8)(1, 2, 4, 8, 16, 32, 64, 128);
    const int8 chosen = ((int8)((int)set) & bit) != 0;
    global int* row = out + 10 * set;
    row[0] = (int)lane_mask(chosen);
    row[1] = least_lane(select((int8)(99), (int8)(7, 6, 5, 4, 3, 2, 1, 0), chosen));
    vstore8(pack_lanes((int8)(10, 11, 12, 13, 14, 15, 16, 17), set), 0, row + 2);
}
)";

// Exact: every set of eight lanes, in each of the ways that this device's compiler can do.
TEST(Simd, MasksAndPacksLanes) {
    for (const char* without : {"", "#undef __AVX2__\n#undef __AVX__\n"}) {
        const Probe probe({"geometry/simd.cl"}, text, without);
        const auto out = probe.run<cl_int>("lanes", 256, std::size_t{10} * 256);
        for (std::size_t set = 0; set < 256; ++set) {
            const cl_int* row = &out[10 * set];
            EXPECT_EQ(row[0], static_cast<int>(set)) << without;
            EXPECT_EQ(row[1], set == 0 ? 99 : 8 - std::bit_width(set)) << without;
            std::size_t packed = 2;
            for (int lane = 0; lane < 8; ++lane) {
                if ((set >> lane & 1U) == 0) continue;
                EXPECT_EQ(row[packed], 10 + lane) << set << without;
                ++packed;
            }
        }
    }
}

}  // namespace
}  // namespace wavepath
