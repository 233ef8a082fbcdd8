#include "support/rendering.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>

namespace wavepath {

namespace {

constexpr double power_z = 2.3263;  // of probability .99

// Of the sums of single-precision products along a path, relative. The paths of these tests are
// short.
constexpr double rounding = 3e-6;

double critical_t(double degrees, const Strictness& s) {
    return student_critical(sidak(false_alarm, s.tests) / 2, degrees);
}

testing::AssertionResult judge(
    const Estimate& difference,
    double scale,
    double critical,
    const Strictness& s,
    const std::string& what) {
    const double chance = critical * difference.error;
    if (!(std::abs(difference.mean) <= chance + (rounding + s.truth_error) * std::abs(scale)))
        return testing::AssertionFailure()
               << what << ": off by " << difference.mean << " = " << 100 * difference.mean / scale
               << " %, " << difference.mean / difference.error << " standard errors; critical "
               << critical;
    if (!((critical + power_z) * difference.error <= s.bias * std::abs(scale)))
        return testing::AssertionFailure()
               << what << ": too few samples to catch a bias of " << 100 * s.bias
               << " %: relative standard error " << difference.error / scale << ", needed "
               << s.bias / (critical + power_z);
    return testing::AssertionSuccess()
           << what << ": " << difference.mean / difference.error << " standard errors of "
           << difference.error / scale << " relative";
}

}  // namespace

bool long_tests_wanted() {
    const char* wanted = std::getenv("WAVEPATH_LONG_TESTS");
    return wanted != nullptr && std::string(wanted) == "1";
}

RenderSettings square_settings(
    const std::string& method, const Camera& camera, uint32_t size, uint64_t samples) {
    RenderSettings settings;
    settings.method = method_named(method);
    settings.camera = camera;
    settings.width = size;
    settings.height = size;
    settings.samples = samples;
    return settings;
}

RenderResult render_scene(const Scene& scene, const RenderSettings& settings) {
    RenderResult result = render(test_device(), scene, settings);
    EXPECT_EQ(result.film.nonfinite.samples, 0U) << scene.name;
    EXPECT_EQ(result.program.log.find("warning:"), std::string::npos) << result.program.log;
    return result;
}

RenderResult render_for(
    const Strictness& strictness,
    const Scene& scene,
    RenderSettings settings,
    const std::string& channel) {
    RenderResult pilot = render_scene(scene, settings);
    const Estimate e = image_mean(pilot, channel);
    // Three tenths more: the pilot knows its error to 10 % at best, and the test measures its own
    // once more.
    const double found = 1.3 * (critical_t(e.degrees, strictness) + power_z) * e.error / e.mean;
    if (!(found > strictness.bias)) return pilot;
    const double samples =
        static_cast<double>(settings.samples) * std::pow(found / strictness.bias, 2);
    const double most = long_tests_wanted() ? 1e9 : 2e7;
    if (!(samples * settings.width * settings.height < most)) {
        ADD_FAILURE() << scene.name << ": too noisy for a test, " << samples << " samples a pixel";
        return pilot;
    }
    settings.samples = static_cast<uint64_t>(std::ceil(samples / 16)) * 16;  // whole batches
    settings.seed += 1000;
    return render_scene(scene, settings);
}

Estimate estimate_of(const std::vector<double>& values) {
    Moments moments;
    for (const double x : values) moments.add(x);
    return {moments.mean(), moments.standard_error(), static_cast<double>(values.size() - 1)};
}

Estimate shared_mean(const RenderResult& result, const std::string& channel) {
    const std::vector<float>& pixels = result.film.image.channels.at(channel);
    return estimate_of({pixels.begin(), pixels.end()});
}

namespace {

// The pixels of block 0..63 of an 8 x 8 grid.
std::vector<float> block_of(const Image& image, const std::string& channel, uint32_t block) {
    const std::vector<float>& pixels = image.channels.at(channel);
    const uint32_t width = image.width / 8;
    const uint32_t height = image.height / 8;
    std::vector<float> values;
    for (uint32_t y = block / 8 * height; y < (block / 8 + 1) * height; ++y)
        for (uint32_t x = block % 8 * width; x < (block % 8 + 1) * width; ++x)
            values.push_back(pixels[y * image.width + x]);
    return values;
}

Estimate mean_of(
    const std::vector<float>& pixels, const std::vector<float>& variances, uint32_t batches) {
    const auto n = static_cast<double>(pixels.size());
    double sum = 0;
    double squares = 0;
    for (const float v : variances) {
        sum += v;
        squares += double{v} * v;
    }
    // Welch and Satterthwaite: pixels of unequal variance share fewer degrees of freedom
    const double effective = squares > 0 ? sum * sum / squares : n;
    return {
        std::accumulate(pixels.begin(), pixels.end(), 0.0) / n, std::sqrt(sum) / n,
        effective * (batches - 1)};
}

}  // namespace

Estimate image_mean(const RenderResult& result, const std::string& channel) {
    const auto& channels = result.film.image.channels;
    return mean_of(channels.at(channel), channels.at("variance." + channel), result.batches);
}

std::vector<Estimate> block_image_means(const RenderResult& result, const std::string& channel) {
    const Image& image = result.film.image;
    std::vector<Estimate> blocks;
    for (uint32_t block = 0; block < 64; ++block)
        blocks.push_back(mean_of(
            block_of(image, channel, block), block_of(image, "variance." + channel, block),
            result.batches));
    return blocks;
}

std::vector<Estimate> block_means(const RenderResult& result, const std::string& channel) {
    std::vector<Estimate> blocks;
    for (uint32_t block = 0; block < 64; ++block) {
        const std::vector<float> pixels = block_of(result.film.image, channel, block);
        blocks.push_back(estimate_of({pixels.begin(), pixels.end()}));
    }
    return blocks;
}

Estimate sample_variance(const RenderResult& result, const std::string& channel) {
    const std::vector<float>& pixels = result.film.image.channels.at(channel);
    const auto n = static_cast<double>(pixels.size());
    const double mean = std::accumulate(pixels.begin(), pixels.end(), 0.0) / n;
    double second = 0;
    double fourth = 0;
    for (const float x : pixels) {
        const double square = (x - mean) * (x - mean);
        second += square / n;
        fourth += square * square / n;
    }
    return {second * n / (n - 1), std::sqrt((fourth - second * second) / n), n - 1};
}

double error_slope(
    const Scene& scene,
    RenderSettings settings,
    uint64_t few,
    uint64_t many,
    const std::string& channel) {
    settings.sobol = false;
    const auto pixels = [&](uint32_t seed) {
        settings.seed = seed;
        return render_scene(scene, settings).film.image.channels.at(channel);
    };
    const auto median_difference = [&](uint64_t samples) {
        settings.samples = samples;
        std::vector<float> differences;
        for (uint32_t pair = 0; pair < 4; ++pair) {
            const std::vector<float> a = pixels(2 * pair + 1);
            const std::vector<float> b = pixels(2 * pair + 2);
            for (std::size_t i = 0; i < a.size(); ++i) differences.push_back(std::abs(a[i] - b[i]));
        }
        const auto middle =
            differences.begin() + static_cast<std::ptrdiff_t>(differences.size() / 2);
        std::ranges::nth_element(differences, middle);
        return double{*middle};
    };
    return std::log(median_difference(many) / median_difference(few)) /
           std::log(static_cast<double>(many) / static_cast<double>(few));
}

testing::AssertionResult has_mean(const Estimate& e, double truth, const Strictness& s) {
    const double critical = critical_t(e.degrees, s);
    return judge(
        {e.mean - truth, e.error, e.degrees}, truth, critical, s,
        fmt::format("{:.8g} against {:.8g}", e.mean, truth));
}

testing::AssertionResult agree(const Estimate& a, const Estimate& b, const Strictness& s) {
    const double degrees = std::min(a.degrees, b.degrees);
    return judge(
        {a.mean - b.mean, std::hypot(a.error, b.error), degrees}, 0.5 * (a.mean + b.mean),
        critical_t(degrees, s), s, fmt::format("{:.8g} against {:.8g}", a.mean, b.mean));
}

}  // namespace wavepath
