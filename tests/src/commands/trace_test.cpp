// `wavepath profile --trace`: what the timeline has to agree with.
#include "support/command.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <map>

namespace wavepath {
namespace {

using Json = nlohmann::json;

class TraceCommand : public CommandTest {
  protected:
    // Of a render that leaves the pool half empty towards its end, so that paths are moved.
    void SetUp() override {
        const Outcome outcome =
            run("profile " + cornell_box + " --size 32x32 --spp 16 --pool 4096 --json " +
                path("report.json") + " --trace " + path("trace.json"));
        ASSERT_EQ(outcome.exit_code, 0) << outcome.words;
        report = CommandTest::json("report.json");
        events = CommandTest::json("trace.json")["traceEvents"];
        if (!report["profile"]["device_clock"].get<bool>()) GTEST_SKIP() << "no times of kernels";
    }

    // Name of the row -> its complete events, in order of time.
    std::map<std::string, std::vector<Json>> rows() const {
        std::map<int, std::string> names;
        for (const Json& event : events)
            if (event["ph"] == "M" && event["name"] == "thread_name")
                names[event["tid"]] = event["args"]["name"];
        std::map<std::string, std::vector<Json>> rows;
        for (const Json& event : events)
            if (event["ph"] == "X") rows[names.at(event["tid"])].push_back(event);
        for (auto& [name, row] : rows)
            std::ranges::stable_sort(row, [](const Json& a, const Json& b) {
                return a["ts"].get<double>() < b["ts"].get<double>();
            });
        return rows;
    }

    // Values of a counter, in order of time.
    std::vector<int64_t> counter(const std::string& name) const {
        std::vector<int64_t> values;
        for (const Json& event : events)
            if (event["ph"] == "C" && event["name"] == name)
                values.push_back(event["args"][name].get<int64_t>());
        return values;
    }

    Json report, events;
};

TEST_F(TraceCommand, EventsOfARowFollowOneAnother) {
    for (const auto& [name, row] : rows())
        for (std::size_t i = 1; i < row.size(); ++i)
            EXPECT_LE(
                row[i - 1]["ts"].get<double>() + row[i - 1]["dur"].get<double>(),
                row[i]["ts"].get<double>() + 1e-3)  // what is left of a nanosecond
                << name;
}

TEST_F(TraceCommand, SumsAreThoseOfTheTable) {
    auto timeline = rows();
    timeline.erase("host");
    EXPECT_EQ(timeline.size(), report["profile"]["kernels"].size());
    for (const Json& kernel : report["profile"]["kernels"]) {
        const std::vector<Json>& row = timeline[kernel["kernel"]];
        double microseconds = 0;
        uint64_t items = 0;
        for (const Json& event : row) {
            microseconds += event["dur"].get<double>();
            items += event["args"]["items"].get<uint64_t>();
        }
        EXPECT_EQ(row.size(), kernel["launches"]) << kernel;
        EXPECT_EQ(items, kernel["items"]) << kernel;
        EXPECT_NEAR(microseconds, 1e6 * kernel["seconds"].get<double>(), 1.0) << kernel;
    }
}

TEST_F(TraceCommand, CountsTheSlotsDownToNone) {
    const std::vector<int64_t> slots = counter("slots with work");
    EXPECT_EQ(slots.front(), 4096);
    EXPECT_EQ(slots.back(), 0);
    EXPECT_EQ(std::ranges::min(slots), 0);
    EXPECT_GT(slots.size(), 3U);
    int64_t rays = 0;
    for (const int64_t count : counter("rays in flight")) {
        EXPECT_GE(count, 0);
        rays += count;
    }
    EXPECT_EQ(rays, report["rays"]["closest_hit"]);
}

// The host waits for the counts once an iteration, folds once a window, and develops once; all of
// that and the kernels lie between the first launch and the last word.
TEST_F(TraceCommand, TellsWhatTheHostDid) {
    std::map<std::string, std::size_t> spans;
    const auto timeline = rows();
    for (const Json& event : timeline.at("host")) ++spans[event["name"]];
    EXPECT_THAT(
        spans, testing::ElementsAre(
                   testing::Pair("develop", 1U), testing::Pair("fold", 1U),
                   testing::Pair("wait for counts", report["profile"]["iterations"]),
                   testing::Pair("write", 1U)));
}

}  // namespace
}  // namespace wavepath
