#include "commands/chart/chart_run.h"

#include "commands/interrupt.h"
#include "commands/render_command.h"
#include "error.h"
#include "image/exr_writer.h"
#include "measure/picture_error.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace wavepath {

namespace {

constexpr uint64_t first_samples = 4;
constexpr uint64_t step = 4;                   // from one number of samples to the next
constexpr uint64_t pilot_samples = 16;         // by which the time of others is foreseen
constexpr double default_budget = 4;           // [s]
constexpr uint32_t reference_seed = 1000001;   // measured renders count from 1
constexpr uint64_t most_samples = 0xFFFFFFFF;  // as --spp has it

std::vector<double> parse_times(const std::string& text) {
    std::vector<double> times;
    const char* const end = text.data() + text.size();
    for (const char* at = text.data(); at < end;) {
        double value = 0;
        const auto [rest, error] = std::from_chars(at, end, value);
        if (error != std::errc{} || !(value > 0) || !std::isfinite(value) ||
            (rest < end && *rest != ','))
            throw Error("--times {}: use seconds above 0, for example 1,2,4,8", text);
        times.push_back(value);
        at = rest + 1;
    }
    std::ranges::sort(times);
    return times;
}

// 4, 16, 64, ... and `most` itself, which is at most most_samples.
std::vector<uint64_t> ladder_to(uint64_t most) {
    std::vector<uint64_t> samples;
    for (uint64_t n = first_samples; n < most; n *= step) samples.push_back(n);
    samples.push_back(most);
    return samples;
}

// The numbers of samples that take these times at `rate` samples/s.
std::vector<uint64_t> samples_for(const std::vector<double>& times, double rate) {
    std::vector<uint64_t> samples;
    for (const double t : times) {
        const double wanted = std::clamp(std::round(rate * t), 1.0, double{most_samples});
        const auto n = static_cast<uint64_t>(wanted);
        if (samples.empty() || samples.back() < n) samples.push_back(n);
    }
    return samples;
}

std::vector<std::filesystem::path> files_of(const ChartOptions& options, const RenderJob& job) {
    std::vector<std::filesystem::path> files = job.scene.files;
    files.push_back(options.render.scene);
    if (!options.render.environment.empty()) files.push_back(options.render.environment);
    return files;
}

class ChartRun {
  public:
    ChartRun(
        const ChartOptions& options,
        const RenderJob& job,
        const std::vector<Variant>& variants,
        const Devices& devices,
        const std::function<bool()>& stop)
        : options_(options),
          job_(job),
          stop_(stop),
          wanted_(variants),
          renders_(options.folder / "renders", job, files_of(options, job), devices) {
        result_.scene = job.scene.name;
        result_.width = job.settings.width;
        result_.height = job.settings.height;
        result_.command = options.command;
        result_.device = devices.at(variants.front().device).info.name;
    }

    ChartResult run() {
        try {
            if (!options_.reference.empty()) make_references();
            plan();
            if (options_.reference.empty()) make_references();
            for (uint32_t seed = 1; seed <= options_.seeds; ++seed) {
                for (std::size_t i = 0; i < variants_.size(); ++i) measure(i, seed);
                result_.seeds = seed;
            }
        } catch (const Interrupted&) {
            spdlog::warn("interrupted: the same command goes on with what was rendered so far");
            if (result_.seeds == 0) throw;
            result_.interrupted = true;
        }
        for (std::size_t i = 0; i < variants_.size(); ++i)
            result_.curves[i] = measure_curve(
                std::move(result_.curves[i]), last_pictures_[i], reference_of(variants_[i]));
        choose_pictures();
        spdlog::info("{} pictures rendered, {} found", renders_.rendered(), renders_.found());
        return std::move(result_);
    }

  private:
    KeptRender render(std::size_t variant, uint64_t samples, uint32_t seed) {
        return renders_.get(variants_[variant], samples, seed, stop_);
    }

    // Which numbers of samples a variant takes, where times are asked for by a pilot's time.
    std::vector<uint64_t> samples_of(const Variant& variant) {
        const std::vector<double> times = parse_times(options_.times);
        const uint64_t most = options_.render.spp.value_or(pilot_samples);
        const double seconds =
            renders_.get(variant, std::min(most, pilot_samples), 1, stop_).seconds;
        if (options_.render.spp) return ladder_to(most);
        const double rate = static_cast<double>(pilot_samples) / seconds;
        if (!times.empty()) return samples_for(times, rate);
        return ladder_to(samples_for({options_.budget.value_or(default_budget)}, rate).front());
    }

    void plan() {
        std::string reason;
        for (const Variant& variant : wanted_) {
            std::vector<uint64_t> samples;
            try {
                samples = samples_of(variant);
            } catch (const Error& error) {
                reason = fmt::format("\"{}\": {}", variant.label, error.what());
                spdlog::warn("{}; it is left out", reason);
                continue;
            }
            variants_.push_back(variant);
            VariantCurve& curve = result_.curves.emplace_back();
            curve.label = variant.label;
            for (const uint64_t n : samples) curve.points.emplace_back().samples = n;
            most_samples_ = std::max(most_samples_, samples.back());
        }
        if (variants_.empty()) throw Error("nothing is left to compare: {}", reason);
        last_pictures_.resize(variants_.size());
    }

    // A method is judged by pictures of another one, so that a bias of its own shows, unless those
    // are far noisier.
    void make_references() {
        if (options_.reference.empty()) {
            references_ = {render_reference("mis"), render_reference("direct-bsdf")};
            const Ratio ratio = ratio_of_means(references_[0].half1, references_[1].half1);
            const bool too_noisy = references_[1].rel_mse > 4 * references_[0].rel_mse;
            if (too_noisy) references_[1] = references_[0];
            references_[0].text += fmt::format(
                " They are by mis{}; the ratio of the means of both methods is {:.5g} +- {:.2g}.",
                too_noisy ? ", for mis itself too, since those of direct-bsdf are far noisier here"
                          : ", for mis itself by direct-bsdf",
                ratio.value, ratio.standard_error);
        } else {
            Reference reference;
            reference.half1 = read_exr(options_.reference);
            reference.half2 = reference.half1;
            reference.rel_mse = std::nan("");
            reference.text = fmt::format(
                "R is {}, whose own error is not known and is in all that follows.",
                options_.reference.string());
            check_size(reference.half1);
            references_ = {reference, reference};
        }
        result_.reference = references_[0];
    }

    void check_size(const Image& reference) const {
        if (reference.width != result_.width || reference.height != result_.height)
            throw Error(
                "--reference {}: has {} x {} pixels, and the picture {} x {}; give --size",
                options_.reference.string(), reference.width, reference.height, result_.width,
                result_.height);
    }

    Reference render_reference(const std::string& method) {
        RenderOptions options = options_.render;
        options.method = method;
        options.termination = "roulette";
        Variant variant = parse_variants(method, options, job_).front();
        variant.label = "reference by " + method;
        const uint64_t samples =
            options_.reference_spp.value_or(std::min(4 * most_samples_, most_samples));
        spdlog::info("reference: two halves of {} samples by {}", samples, method);
        Reference reference;
        reference.half1 = renders_.get(variant, samples, reference_seed, stop_).image;
        reference.half2 = renders_.get(variant, samples, reference_seed + 1, stop_).image;
        reference.rel_mse = rel_mse_of_halves(reference.half1, reference.half2).value;
        reference.text = fmt::format(
            "R is two independent halves of {} samples; (A - R1)(A - R2) stands for (A - R)^2, so "
            "that their noise adds nothing on average.",
            samples);
        return reference;
    }

    const Reference& reference_of(const Variant& variant) const {
        return references_[variant.settings.method.name == "mis" ? 1 : 0];
    }

    // A seed counts once all of its renders are there.
    void measure(std::size_t i, uint32_t seed) {
        VariantCurve& curve = result_.curves[i];
        std::vector<KeptRender> renders;
        for (const ChartPoint& point : curve.points)
            renders.push_back(render(i, point.samples, seed));
        for (std::size_t k = 0; k < renders.size(); ++k) {
            add_errors(curve.points[k], renders[k], reference_of(variants_[i]));
            curve.nonfinite_samples += renders[k].nonfinite_samples;
        }
        curve.bias = renders.back().bias;
        curve.command = render_command(renders.back().image);
        last_pictures_[i].push_back(std::move(renders.back().image));
        const ChartPoint& last = curve.points.back();
        spdlog::info(
            "{}, seed {} of {}: relMSE {:.3g} at {} samples in {:.3g} s", curve.label, seed,
            options_.seeds, last.rel_mses.back(), last.samples, last.seconds.back());
    }

    // Of every variant the picture whose time is nearest to the longest that all have.
    void choose_pictures() {
        double longest = INFINITY;
        for (const VariantCurve& curve : result_.curves)
            longest = std::min(longest, curve.points.back().median_seconds());
        for (std::size_t i = 0; i < variants_.size(); ++i) {
            const ChartPoint& nearest = *std::ranges::min_element(
                result_.curves[i].points, {}, [&](const ChartPoint& point) {
                    return std::abs(std::log(point.median_seconds() / longest));
                });
            result_.pictures.push_back(
                {i, nearest.samples, nearest.median_seconds(),
                 render(i, nearest.samples, 1).image});
        }
    }

    const ChartOptions& options_;
    const RenderJob& job_;
    const std::function<bool()>& stop_;
    const std::vector<Variant>& wanted_;
    KeptRenders renders_;
    std::vector<Variant> variants_;  // that can be rendered
    uint64_t most_samples_ = 0;
    std::vector<Reference> references_;  // of all but mis, of mis
    std::vector<std::vector<Image>> last_pictures_;
    ChartResult result_;
};

}  // namespace

ChartResult run_chart(
    const ChartOptions& options,
    const RenderJob& job,
    const std::vector<Variant>& variants,
    const Devices& devices,
    const std::function<bool()>& stop) {
    return ChartRun(options, job, variants, devices, stop).run();
}

}  // namespace wavepath
