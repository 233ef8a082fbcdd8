#include "commands/roofline.h"

#include "device/program.h"

#include <gmock/gmock.h>

namespace wavepath {
namespace {

using testing::HasSubstr;
using Json = nlohmann::json;

// Kernels that ran for a second each over 10^9 items.
RenderResult result_of(const std::vector<std::string>& kernels, const std::string& tracing) {
    RenderResult result;
    for (const std::string& kernel : kernels) {
        result.profile.push_back({kernel, 1, 1'000'000'000, 1.0});
        result.tracing = tracing;
    }
    return result;
}

constexpr Peaks peaks{20e9, 100e9, 8};  // ridge at 5 flop/B

TEST(Peaks, RoofIsTheLowerOfBothSides) {
    EXPECT_DOUBLE_EQ(peaks.roof(1), 20e9);
    EXPECT_DOUBLE_EQ(peaks.roof(5), 100e9);
    EXPECT_DOUBLE_EQ(peaks.roof(50), 100e9);
}

TEST(Roofline, RatesAreCountsTimesItemsASecond) {
    const Roofline roofline = roofline_of(result_of({"first_hit", "scan_queue"}, "packets"), peaks);
    const Json table = Json::parse(kernel_file("counts.json"))["kernels"];
    ASSERT_EQ(roofline.rows.size(), 2U);
    for (const RooflineRow& row : roofline.rows) {
        const Json& count = table[row.kernel]["counts"][0];
        EXPECT_DOUBLE_EQ(row.flops_per_s, 1e9 * count["flops"].get<double>());
        EXPECT_DOUBLE_EQ(row.bytes_per_s, 1e9 * count["bytes"].get<double>());
        EXPECT_EQ(row.counted_on, count["scene"]);
        EXPECT_TRUE(row.same_tracing);
    }
}

TEST(Roofline, ShareIsOfTheRoofAtTheRowsIntensity) {
    const Roofline roofline{peaks, "", {}};
    RooflineRow row;
    for (const double flops : {0.5, 40.0, 4000.0}) {
        row.flops_per_item = row.flops_per_s = flops;
        row.bytes_per_item = row.bytes_per_s = 8;
        EXPECT_DOUBLE_EQ(roofline.share_of_roof(row), flops / peaks.roof(row.flops_per_byte()));
    }
    row.flops_per_item = row.flops_per_s = 0;  // bytes alone
    EXPECT_DOUBLE_EQ(roofline.share_of_roof(row), 8 / 20e9);
}

TEST(Roofline, EachWayOfTracingHasItsRow) {
    for (const std::string tracing : {"packets", "streams", "single rays"}) {
        const Roofline roofline = roofline_of(result_of({"intersect"}, tracing), peaks);
        EXPECT_THAT(roofline.rows.front().counted_on, HasSubstr(", " + tracing));
        EXPECT_TRUE(roofline.rows.front().same_tracing) << tracing;
    }
}

TEST(Roofline, SaysWhereTheCountIsOfAnotherWayOfTracing) {
    const Roofline roofline = roofline_of(result_of({"intersect"}, "hardware"), peaks);
    EXPECT_FALSE(roofline.rows.front().same_tracing);
    EXPECT_EQ(roofline_report(roofline)["kernels"][0]["same_tracing"], false);
}

TEST(Roofline, LeavesOutWhatDidNotRunAndWhatHasNoTime) {
    RenderResult result = result_of({"interact", "first_hit"}, "packets");
    result.profile[0].items = 0;
    result.profile[1].seconds = 0;
    EXPECT_TRUE(roofline_of(result, peaks).rows.empty());
}

// Whether the counts are those of the kernels' present text is what scripts/kernel_counts.py
// --check asks.
TEST(Roofline, EveryKernelHasACount) {
    const Json table = Json::parse(kernel_file("counts.json"))["kernels"];
    for (const auto& [kernel, row] : table.items()) {
        EXPECT_FALSE(row["counts"].empty()) << kernel;
        for (const Json& count : row["counts"]) EXPECT_GT(count["bytes"], 0) << kernel;
    }
}

}  // namespace
}  // namespace wavepath
