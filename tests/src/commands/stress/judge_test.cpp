// Estimators that are known to fail are found to, by name.
#include "commands/stress/judge.h"

#include "support/rendering.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace wavepath {
namespace {

Situation furnace(const std::string& termination, double albedo) {
    const auto situations = furnace_situations(Effort::quick);
    const auto found = std::ranges::find_if(situations, [&](const Situation& s) {
        return s.method == "--termination " + termination && s.x == albedo;
    });
    EXPECT_NE(found, situations.end());
    return *found;
}

TEST(Judge, FindsSoundWhatIsSound) {
    const Judgement judgement = judge(test_device(), furnace("roulette:0.9", 0.9));
    EXPECT_EQ(judgement.verdict, Verdict::sound);
    EXPECT_EQ(judgement.samples, 65536U);
    // 65536 samples of a kurtosis of some 40 know their variance to 2.5 %.
    EXPECT_NEAR(judgement.relative_variance, 0.9, 5 * 0.025 * 0.9);
    EXPECT_NEAR(judgement.slope.value, -0.5, 0.1);
}

TEST(Judge, FindsWhatADepthCutsOff) {
    const Judgement judgement = judge(test_device(), furnace("depth:5", 0.9));
    EXPECT_EQ(judgement.verdict, Verdict::biased);
    EXPECT_NEAR(judgement.mean, 0.468559, 1e-5);
}

// The standard error of the mean is 0.0037 of it.
TEST(Judge, FindsAMeanThatIsOffByMoreThanChance) {
    Situation situation = furnace("roulette:0.9", 0.9);
    situation.truth *= 1.03;
    EXPECT_EQ(judge(test_device(), situation).verdict, Verdict::biased);
}

TEST(Judge, FindsInfiniteVariance) {
    const Judgement judgement = judge(test_device(), furnace("roulette:0.5", 0.9));
    EXPECT_EQ(judgement.verdict, Verdict::infinite_variance);
    EXPECT_GT(judgement.slope.value, -0.3);  // ln(1/q) / ln(rho/q) = 1.18: slope -0.15
}

TEST(Judge, FindsNoise) {
    for (const Situation& situation : light_situations(Effort::quick)) {
        if (situation.x != 10 || situation.method != "path") continue;
        const Judgement judgement = judge(test_device(), situation);
        EXPECT_EQ(judgement.verdict, Verdict::noisy);
        EXPECT_LT(std::abs(judgement.mean - 1), 4.9 * judgement.standard_error);
    }
}

}  // namespace
}  // namespace wavepath
