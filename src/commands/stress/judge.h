// What a render of a situation says of its estimator.
#pragma once

#include "commands/stress/situation.h"
#include "measure/interval.h"
#include "measure/tail.h"

namespace wavepath {

struct Judgement {
    std::size_t samples = 0;
    double mean = 0;               // relative to the truth
    double standard_error = 0;     // of that, by the larger of the variances measured and predicted
    double relative_variance = 0;  // of one sample
    Tail tail;
    Interval slope;  // of the median error over samples: -0.5 where the variance is finite
    uint64_t nonfinite = 0;
    double seconds = 0;  // of rendering
    Verdict verdict = Verdict::sound;
};

// Samples to an error of 1 % are 10^4 times the relative variance: above this one calls it noisy.
inline constexpr double noisy_variance = 25;

// Renders and judges. By order: `biased` where a sample is not finite; `infinite variance` where
// the tail of the samples says so and no finite variance is predicted, since then a standard error
// means nothing; `biased` where the mean is off by more than chance and the truth's own error;
// `noisy`; `sound`. Throws what render() throws.
Judgement judge(const Device& device, const Situation& situation);

}  // namespace wavepath
