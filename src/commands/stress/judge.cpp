#include "commands/stress/judge.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace wavepath {

namespace {

// |z| that the mean of a right estimator exceeds with a probability of 1e-6, were it normal.
constexpr double critical = 4.8916;

// The median of |mean of m values - 1| over groups of m, for m = 1, 4, 16, ... while 64 groups are
// left. Values in any order: neighbours in a picture need not have one expectation.
Interval slope_of(std::vector<double> values) {
    std::mt19937_64 random(1);
    std::ranges::shuffle(values, random);
    std::vector<double> counts;
    std::vector<double> errors;
    for (std::size_t m = 1; values.size() / m >= 64; m *= 4) {
        std::vector<double> deviations;
        for (std::size_t first = 0; first + m <= values.size(); first += m) {
            double sum = 0;
            for (std::size_t i = first; i < first + m; ++i) sum += values[i];
            deviations.push_back(std::abs(sum / static_cast<double>(m) - 1));
        }
        const auto middle = deviations.begin() + static_cast<std::ptrdiff_t>(deviations.size() / 2);
        std::ranges::nth_element(deviations, middle);
        counts.push_back(static_cast<double>(m));
        errors.push_back(*middle);
    }
    return log_slope(counts, errors);
}

Verdict verdict_of(const Judgement& judgement, const Situation& situation, double variance) {
    const double chance = critical * judgement.standard_error;
    if (judgement.nonfinite > 0) return Verdict::biased;
    if (judgement.tail.infinite_variance && !situation.relative_variance)
        return Verdict::infinite_variance;
    if (std::abs(judgement.mean - 1) > chance + situation.truth_error) return Verdict::biased;
    return variance > noisy_variance ? Verdict::noisy : Verdict::sound;
}

}  // namespace

Judgement judge(const Device& device, const Situation& situation) {
    const RenderResult result = render(device, situation.scene, situation.settings);
    Judgement judgement;
    std::vector<double> values;  // relative to the truth
    for (const float x : result.film.image.channels.at("R"))
        if (std::isfinite(x)) values.push_back(x / situation.truth);
    judgement.nonfinite = result.film.nonfinite.samples;
    judgement.seconds = result.times.render;
    judgement.samples = values.size() * result.samples;
    if (values.empty()) {
        judgement.verdict = Verdict::biased;
        return judgement;
    }
    const auto count = static_cast<double>(values.size());
    for (const double x : values) judgement.mean += x / count;
    double variance = 0;
    std::vector<double> deviations;
    for (const double x : values) {
        deviations.push_back(x - judgement.mean);
        variance += deviations.back() * deviations.back() / (count - 1);
    }
    judgement.relative_variance = variance * static_cast<double>(result.samples);
    judgement.tail = tail_of(deviations);
    judgement.slope = slope_of(values);
    // Rare events may be missing among the samples, and their variance with them.
    const double larger =
        std::max(judgement.relative_variance, situation.relative_variance.value_or(0));
    judgement.standard_error = std::sqrt(larger / static_cast<double>(judgement.samples));
    judgement.verdict = verdict_of(judgement, situation, larger);
    return judgement;
}

}  // namespace wavepath
