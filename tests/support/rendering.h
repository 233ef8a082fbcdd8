// Renders for the statistical tests, and how their pictures are judged: z-tests which a bias of 0.5
// % fails with probability .99 and a right renderer with probability 1e-6 (support/statistics.h).
#pragma once

#include "support/probe.h"
#include "support/scenes.h"
#include "support/statistics.h"
#include "wavefront/renderer.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace wavepath {

// For tests of minutes, whose names end in _long.
bool long_tests_wanted();
#define WAVEPATH_SKIP_UNLESS_LONG() \
    if (!long_tests_wanted()) GTEST_SKIP() << "a long test: set WAVEPATH_LONG_TESTS=1"

// Of a square image of `size` pixels a side.
RenderSettings square_settings(
    const std::string& method, const Camera& camera, uint32_t size, uint64_t samples);

RenderResult render_scene(const Scene& scene, const RenderSettings& settings);

struct Strictness {
    double bias = 0.005;     // relative: what the test has to catch with probability .99
    std::size_t tests = 1;   // simultaneous ones
    double truth_error = 0;  // relative error of the truth itself: tessellation, table digits
};

// A pilot of settings.samples says how many samples the test needs; a second render, with another
// seed, takes them.
RenderResult render_for(
    const Strictness& strictness,
    const Scene& scene,
    RenderSettings settings,
    const std::string& channel = "R");

// A mean with its standard error, and the degrees of freedom the error rests on.
struct Estimate {
    double mean = 0, error = 0, degrees = 0;
};

// Of independent values of one mean.
Estimate estimate_of(const std::vector<double>& values);

// Of an image whose pixels all have the same expected value: the error is the pixels' own scatter.
Estimate shared_mean(const RenderResult& result, const std::string& channel = "R");

// Of an image whose pixels differ: the error comes from the variance layer, which bounds it from
// above.
Estimate image_mean(const RenderResult& result, const std::string& channel = "R");

// The same of its 8 x 8 blocks.
std::vector<Estimate> block_image_means(
    const RenderResult& result, const std::string& channel = "R");

// Of the 8 x 8 blocks of an image whose pixels all have the same expected value.
std::vector<Estimate> block_means(const RenderResult& result, const std::string& channel = "R");

// Variance of one sample, from an image of one independent sample a pixel, and the variance's
// standard error.
Estimate sample_variance(const RenderResult& result, const std::string& channel = "R");

// d log(error) / d log(samples) between `few` and `many` samples a pixel. The error is the median
// over pixels and 4 pairs of seeds of the difference between the two of a pair: it needs no truth
// and no finite variance. Pixels should have like distributions; a median of 64 is good to 15 %, a
// slope over a factor of 64 then to 0.05.
double error_slope(
    const Scene& scene,
    RenderSettings settings,
    uint64_t few,
    uint64_t many,
    const std::string& channel = "R");

// |mean - truth| within chance, and few enough samples not to be the reason.
testing::AssertionResult has_mean(
    const Estimate& e, double truth, const Strictness& strictness = {});
// Two independent estimates of one mean.
testing::AssertionResult agree(
    const Estimate& a, const Estimate& b, const Strictness& strictness = {});

}  // namespace wavepath
