#include "commands/chart/measurement.h"

#include "measure/efficiency.h"
#include "measure/floor.h"
#include "measure/picture_error.h"

#include <algorithm>
#include <cmath>

namespace wavepath {

namespace {

double median(std::vector<double> values) {
    if (values.empty()) return std::nan("");
    const std::size_t middle = values.size() / 2;
    std::ranges::sort(values);
    return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

// What each picture is off the mean of the others, relative, one number a pixel: the samples of the
// variant alone, where deviations from a reference would have its tail too.
std::vector<double> own_deviations(const std::vector<Image>& pictures) {
    std::vector<double> deviations;
    const auto others = static_cast<double>(pictures.size() - 1);
    const std::size_t pixels = std::size_t{pictures[0].width} * pictures[0].height;
    for (std::size_t i = 0; i < pixels; ++i) {
        const auto value = [&](const Image& picture) {
            double sum = 0;
            for (const char* channel : {"R", "G", "B"}) sum += picture.channels.at(channel)[i] / 3;
            return sum;
        };
        double sum = 0;
        for (const Image& picture : pictures) sum += value(picture);
        const double mean = sum / (others + 1);
        for (const Image& picture : pictures) {
            const double own = value(picture);
            const double off = (own - (sum - own) / others) / std::sqrt(mean * mean + 0.01);
            if (std::isfinite(off)) deviations.push_back(off);
        }
    }
    return deviations;
}

// Whether the mean is off by more than chance: 5 standard errors, where the interval has 1.96.
bool is_off(const Interval& floor) {
    return floor.value - 5 / 1.96 * (floor.high - floor.value) > 0;
}

ChartVerdict verdict_of(const VariantCurve& curve) {
    const double last = curve.points.back().median_rel_mse();
    if (curve.nonfinite_samples > 0 || std::isnan(last)) return ChartVerdict::not_finite;
    // A reference whose own error is not known is taken at its word, and its error is in the floor.
    const bool has_halves = std::isfinite(curve.reference_rel_mse);
    if (curve.tail.infinite_variance) return ChartVerdict::infinite_variance;
    if (!curve.bias.empty() || (has_halves && is_off(curve.floor))) return ChartVerdict::biased;
    if (!(last > 0) || last < curve.reference_rel_mse) return ChartVerdict::below_reference;
    return ChartVerdict::sound;
}

}  // namespace

double ChartPoint::median_seconds() const {
    return median(seconds);
}

double ChartPoint::median_mse() const {
    return median(mse);
}

double ChartPoint::median_rel_mse() const {
    return median(rel_mses);
}

void add_errors(ChartPoint& point, const KeptRender& render, const Reference& reference) {
    point.seconds.push_back(render.seconds);
    point.mse.push_back(mse(render.image, reference.half1, reference.half2).value);
    point.rel_mses.push_back(rel_mse(render.image, reference.half1, reference.half2).value);
}

VariantCurve measure_curve(
    VariantCurve curve, const std::vector<Image>& last_pictures, const Reference& reference) {
    std::vector<double> samples;
    std::vector<double> seconds;
    std::vector<double> errors;
    for (const ChartPoint& point : curve.points) {
        // Where the reference is no better than the picture, its noise would flatten the line.
        if (point.median_rel_mse() < reference.rel_mse) continue;
        samples.push_back(static_cast<double>(point.samples));
        seconds.push_back(point.median_seconds());
        errors.push_back(point.median_rel_mse());
    }
    curve.slope_samples = log_slope(samples, errors);
    curve.slope_time = log_slope(seconds, errors);
    const ChartPoint& last = curve.points.back();
    curve.efficiency = efficiency(last.rel_mses, last.seconds);
    curve.floor = bias_floor(last_pictures, reference.half1, reference.half2);
    curve.tail = tail_of(own_deviations(last_pictures));
    curve.reference_rel_mse = reference.rel_mse;
    curve.verdict = verdict_of(curve);
    return curve;
}

std::string name_of(ChartVerdict verdict) {
    switch (verdict) {
        case ChartVerdict::sound:
            return "sound";
        case ChartVerdict::biased:
            return "biased";
        case ChartVerdict::infinite_variance:
            return "infinite variance";
        case ChartVerdict::not_finite:
            return "samples that are not finite";
        case ChartVerdict::below_reference:
            return "as good as the reference";
    }
    return {};
}

std::optional<std::size_t> winner_of(const std::vector<VariantCurve>& curves) {
    const auto is_ranked = [](const VariantCurve& curve) {
        return curve.verdict == ChartVerdict::sound && std::isfinite(curve.efficiency.value);
    };
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < curves.size(); ++i)
        if (is_ranked(curves[i]) &&
            (!best || curves[i].efficiency.value > curves[*best].efficiency.value))
            best = i;
    if (std::ranges::count_if(curves, is_ranked) < 2) return std::nullopt;
    for (std::size_t i = 0; i < curves.size(); ++i) {
        if (i == *best || !is_ranked(curves[i])) continue;
        const Interval ratio = efficiency_ratio(curves[*best].efficiency, curves[i].efficiency);
        if (!(ratio.low > 1)) return std::nullopt;
    }
    return best;
}

}  // namespace wavepath
