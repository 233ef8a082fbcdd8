// What a chart measures: the error of every variant at every number of samples, over seeds.
#pragma once

#include "commands/chart/kept_renders.h"
#include "measure/interval.h"
#include "measure/tail.h"

#include <optional>
#include <string>
#include <vector>

namespace wavepath {

// The truth that errors are told by.
struct Reference {
    // Two independent halves, so that their noise adds nothing to an error on average
    // (measure/picture_error.h); one picture twice where there is no more.
    Image half1, half2;
    std::string text;    // how it came about
    double rel_mse = 0;  // its own; NaN: not known
};

// One number of samples of a variant.
struct ChartPoint {
    uint64_t samples = 0;
    std::vector<double> seconds;        // of each seed
    std::vector<double> mse, rel_mses;  // of each seed; by chance below 0 near the reference's own
    double median_seconds() const;
    double median_mse() const;
    double median_rel_mse() const;
};

enum class ChartVerdict {
    sound,
    biased,             // by what its settings say, or beyond chance
    infinite_variance,  // so that no error tells what the next one will be
    not_finite,         // some samples
    below_reference,    // as near to the truth as the reference is
};

struct VariantCurve {
    std::string label;
    std::string command;  // of its last picture
    std::string bias;
    std::vector<ChartPoint> points;  // ascending
    uint64_t nonfinite_samples = 0;
    Interval slope_samples, slope_time;  // of log relMSE over log samples, log time
    Interval efficiency;                 // of the last point [1/s]
    Interval floor;                      // relMSE that more samples do not take away
    Tail tail;                           // of the seeds' deviations at the last point
    double reference_rel_mse = 0;        // of the reference that it is judged by
    ChartVerdict verdict = ChartVerdict::sound;
};

// The pictures of all seeds at the last point are needed together; those of other points come and
// go one by one.
VariantCurve measure_curve(
    VariantCurve curve, const std::vector<Image>& last_pictures, const Reference& reference);

// Adds the errors of a picture to its point.
void add_errors(ChartPoint& point, const KeptRender& render, const Reference& reference);

std::string name_of(ChartVerdict verdict);

// Of sound curves the most efficient one, if its interval says so against each of the others; with
// fewer than two sound ones none.
std::optional<std::size_t> winner_of(const std::vector<VariantCurve>& curves);

}  // namespace wavepath
