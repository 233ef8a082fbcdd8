#include "support/grid.h"
#include "support/probe.h"
#include "support/statistics.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace wavepath {
namespace {

using std::numbers::pi;

const Grid grid;

const Probe& probe() {
    static const Probe instance({"materials/ggx.cl"}, grid_functions(grid) + R"(
INLINE Vec3 viewer(const float mu) {
    return vec3(sqrt(1.0f - mu * mu), 0.0f, mu);
}

// x = z of the half-vector with the lobe stretched to a hemisphere, so that one grid suits every alpha; y = azimuth
kernel void normals(const uint count, global uint* out, const float alpha, const float mu) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    const Vec3 m = ggx_sample(viewer(mu), alpha, unit_pair(independent_pair(i, 21)));
    const float z = alpha * m.z;
    const float x = z / sqrt(m.x * m.x + m.y * m.y + z * z);
    grid_count(out, x, atan2(m.y, m.x) * (0.5f * INV_PI_F) + 0.5f);
}

kernel void densities(
    const uint count, global float* out, const float alpha, const float mu,
    global const float* normals) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    const Vec3 m = vec3(normals[3 * i], normals[3 * i + 1], normals[3 * i + 2]);
    out[i] = ggx_pdf_w(viewer(mu), m, alpha);
}

// means of m.x, m.z, m.z^2, wo.m over n samples an item
kernel void moments(
    const uint count, global float* out, const float alpha, const float mu, const uint n) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    float sums[4] = {0.0f, 0.0f, 0.0f, 0.0f};
    for (uint k = 0; k < n; ++k) {
        const Vec3 m = ggx_sample(viewer(mu), alpha, unit_pair(independent_pair(i * n + k, 22)));
        sums[0] += m.x;
        sums[1] += m.z;
        sums[2] += m.z * m.z;
        sums[3] += dot3(viewer(mu), m);
    }
    for (int k = 0; k < 4; ++k) out[4 * i + k] = sums[k] / (float)n;
}

// F = 1: means of the weight f cos / pdf_w and of its square, and the largest, over n samples an item.
// by_cosine: directions are cosine-distributed instead of visible normals' reflections
kernel void weights(
    const uint count, global float* out, const float alpha, const float mu, const uint by_cosine,
    const uint n) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    const Vec3 wo = viewer(mu);
    float sum = 0.0f;
    float squares = 0.0f;
    float largest = 0.0f;
    for (uint k = 0; k < n; ++k) {
        const Sample2 u = unit_pair(independent_pair(i * n + k, 23));
        Vec3 m = ggx_sample(wo, alpha, u);
        Vec3 wi = sub3(scale3(m, 2.0f * dot3(wo, m)), wo);
        float pdf_w = ggx_pdf_w(wo, m, alpha);
        if (by_cosine) {
            wi = sample_cosine(u);
            m = normalize3(add3(wo, wi));
            pdf_w = wi.z * INV_PI_F;
        }
        const float above = ggx_eval(wo, wi, m, alpha) / pdf_w;
        const float weight = wi.z > 0.0f ? above : 0.0f;  // no branch: docs/devices.md, PoCL 6.0
        sum += weight;
        squares += weight * weight;
        largest = max(largest, weight);
    }
    out[3 * i] = sum / (float)n;
    out[3 * i + 1] = squares / (float)n;
    out[3 * i + 2] = largest;
}

// how many of the values at grazing angles are not finite, or negative
kernel void grazing(
    const uint count, global uint* out, const float alpha, const float mu_o, const float mu_i) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    const Sample2 u = unit_pair(independent_pair(i, 24));
    const Vec3 wo = viewer(mu_o);
    const SineCosine phi = sincos_2pi(u.u * 0.98f - 0.49f);  // not opposite to wo: m would be 0 / 0
    const float sine = sqrt(1.0f - mu_i * mu_i);
    const Vec3 wi = vec3(sine * phi.cosine, sine * phi.sine, mu_i);
    const Vec3 half_vector = normalize3(add3(wo, wi));
    const Vec3 m = ggx_sample(wo, alpha, u);
    const float values[5] = {
        mu_i > 0.0f ? ggx_eval(wo, wi, half_vector, alpha) : 0.0f,
        ggx_pdf_w(wo, half_vector, alpha), ggx_pdf_w(wo, m, alpha), m.z,
        dot3(m, m)};
    for (int k = 0; k < 5; ++k)
        if (!(values[k] >= 0.0f && values[k] < INFINITY)) atomic_inc(out + k);
}
)");
    return instance;
}

struct Lobe {
    float alpha, mu;
};

// Density of the visible normals in the coordinates of kernel `normals`, times 4 wo.m for that of
// half-vectors.
std::vector<double> normal_densities(const Lobe& lobe) {
    std::vector<cl_float> normals;
    std::vector<double> factors;
    const double alpha2 = double{lobe.alpha} * lobe.alpha;
    const double sine = std::sqrt(1 - double{lobe.mu} * lobe.mu);
    for (const auto& [x, y] : grid_nodes(grid)) {
        const double root = alpha2 / (x * x + alpha2 * (1 - x * x));
        const double cos2 = x * x * root / alpha2;
        const double sin2 = (1 - x * x) * root;
        const double phi = 2 * pi * (y - 0.5);
        const double m[3] = {
            std::sqrt(sin2) * std::cos(phi), std::sqrt(sin2) * std::sin(phi), std::sqrt(cos2)};
        for (const double c : m) normals.push_back(static_cast<cl_float>(c));
        const double solid_angle = 2 * pi * x * root * root / (m[2] * alpha2);
        factors.push_back(4 * std::fmax(0, sine * m[0] + lobe.mu * m[2]) * solid_angle);
    }
    const auto pdfs = probe().run<cl_float>(
        "densities", factors.size(), factors.size(), lobe.alpha, lobe.mu, normals);
    for (std::size_t k = 0; k < factors.size(); ++k) factors[k] *= pdfs[k];
    return factors;
}

// alpha: false_alarm over the lobes' pairs of grids; power in support/grid.h.
TEST(Ggx, HalfVectorsFollowTheirDensity) {
    const std::vector<Lobe> lobes{{0.001F, 0.5F}, {0.01F, 1},    {0.01F, 0.05F}, {0.1F, 0.7F},
                                  {0.1F, 0.1F},   {0.5F, 0.01F}, {0.5F, 0.5F},   {1, 0.3F}};
    for (const Lobe& lobe : lobes) {
        SCOPED_TRACE(testing::Message() << "alpha " << lobe.alpha << ", mu " << lobe.mu);
        const auto probabilities = grid_probabilities(grid, normal_densities(lobe));
        EXPECT_EQ(probabilities.back(), 0) << "the density integrates to less than 1";
        expect_distribution(
            grid,
            probe().run<cl_uint>(
                "normals", scaled(1U << 21U), grid.cells() + 1, lobe.alpha, lobe.mu),
            probabilities, lobes.size());
    }
}

// By quadrature of the density [Heitz 2018, eq. 3]; alpha: false_alarm over 32 means, 1 % found
// with probability .99.
TEST(Ggx, MomentsOfVisibleNormals) {
    struct Row {
        float alpha, mu;
        std::size_t samples;  // of each of 1024 batches; E m.x may be small against its spread
        std::array<double, 4> truths;  // E m.x, m.z, m.z^2, wo.m
    };
    const std::vector<Row> rows{
        {0.1F, 0.7F, 24576, {0.0235524, 0.9778515, 0.9608768, 0.7013158}},
        {0.1F, 0.3F, 8192, {0.0627323, 0.9692838, 0.9489591, 0.3506279}},
        {0.1F, 0.05F, 2048, {0.1818048, 0.9230661, 0.8807391, 0.2277307}},
        {0.5F, 0.7F, 2048, {0.2198184, 0.7930602, 0.6810434, 0.7121239}},
        {0.5F, 0.3F, 2048, {0.4014213, 0.7127435, 0.5821852, 0.5967546}},
        {0.5F, 0.05F, 2048, {0.5282623, 0.6238399, 0.4711653, 0.5587936}},
        {1, 0.7F, 2048, {0.4183010, 0.5883062, 1.7 / 4, 0.7105410}},
        {1, 0.3F, 2048, {0.5840913, 0.4951223, 1.3 / 4, 0.7057243}}};
    constexpr std::size_t batches = 1024;
    for (const Row& row : rows) {
        const auto n = static_cast<cl_uint>(scaled(row.samples));
        const auto out =
            probe().run<cl_float>("moments", batches, 4 * batches, row.alpha, row.mu, n);
        for (std::size_t k = 0; k < 4; ++k) {
            Moments moments;
            for (std::size_t i = 0; i < batches; ++i) moments.add(out[4 * i + k]);
            EXPECT_TRUE(mean_is(moments, row.truths[k], 4 * rows.size(), 0.01))
                << "alpha " << row.alpha << ", mu " << row.mu << ", moment " << k;
        }
    }
}

struct Weights {
    Moments weight, square;
    float largest = 0;
};

Weights weights(float alpha, float mu, bool by_cosine, std::size_t samples) {
    constexpr std::size_t batches = 512;
    const auto n = static_cast<cl_uint>(scaled(samples / batches));
    const auto out = probe().run<cl_float>(
        "weights", batches, 3 * batches, alpha, mu, static_cast<cl_uint>(by_cosine), n);
    Weights result;
    for (std::size_t i = 0; i < batches; ++i) {
        result.weight.add(out[3 * i]);
        result.square.add(out[3 * i + 1]);
        result.largest = std::fmax(result.largest, out[3 * i + 2]);
    }
    return result;
}

// F = 1, by two quadratures that agree to 2e-6 (alpha = .01: 5e-6; .001: E = 1 - O(alpha^2)).
// alpha: false_alarm over 44 means, a bias of 0.5 % found with probability .99.
TEST(Ggx, DirectionalAlbedo) {
    struct Row {
        float alpha;
        std::size_t samples;
        std::array<double, 7> albedos;
    };
    const std::array<float, 7> mus{1, 0.9F, 0.7F, 0.5F, 0.3F, 0.1F, 0.05F};
    const std::vector<Row> rows{
        {0.01F, 1U << 17U, {.999899, .999886, .999845, .999742, .999361, .994124, .976208}},
        {0.1F, 1U << 19U, {.988304, .986744, .981419, .969205, .936252, .883455, .911763}},
        {0.25F, 1U << 19U, {.915812, .907383, .885336, .857263, .837906, .891622, .933132}},
        {0.5F, 1U << 20U, {.687849, .683961, .682954, .698251, .745272, .860105, .912548}},
        {0.7F, 1U << 21U, {.503718, .513625, .542640, .589901, .669238, .820917, .887201}},
        {1, 1U << 22U, {.30685282, .327507, .378888, .450694, .560099, .760210, .847774}}};
    constexpr std::size_t comparisons = 44;
    for (const Row& row : rows)
        for (std::size_t k = 0; k < mus.size(); ++k) {
            const Weights w = weights(row.alpha, mus[k], false, row.samples);
            EXPECT_TRUE(mean_is(w.weight, row.albedos[k], comparisons, 0.005, 6e-6))
                << "alpha " << row.alpha << ", mu " << mus[k];
            EXPECT_LE(w.largest, 1 + 2e-6F) << "alpha " << row.alpha << ", mu " << mus[k];
        }
    for (const float mu : {1.0F, 0.5F})
        EXPECT_TRUE(
            mean_is(weights(0.001F, mu, false, 1U << 17U).weight, 1, comparisons, 0.005, 6e-6));
}

// Relative variance of the weight, F = 1: how good the sampling is. The second moment is tested,
// where four moments are known to exist and its error is small: alpha false_alarm over 15, a 10 %
// change of the variance found with probability .99.
TEST(Ggx, VarianceOfTheWeight) {
    struct Row {
        float alpha, mu;
        double albedo, visible_normals, cosine;  // cosine 0: too long a tail for a test in seconds
    };
    const std::vector<Row> rows{
        {0.1F, 1, .988304, .01056, 0},     {0.1F, 0.5F, .969205, .01891, 0},
        {0.1F, 0.1F, .883455, .06229, 0},  {0.25F, 1, .915812, .07174, .8199},
        {0.25F, 0.5F, .857263, .1002, 0},  {0.25F, 0.1F, .891622, .05652, 0},
        {0.5F, 1, .687849, .3184, .03702}, {0.5F, 0.5F, .698251, .2694, .7487},
        {0.5F, 0.1F, .860105, .08163, 0},  {1, 1, .306853, 1.415, .02565},
        {1, 0.5F, .450694, .7333, .06325}, {1, 0.1F, .760210, .1636, .2881}};
    for (const Row& row : rows)
        for (const bool by_cosine : {false, true}) {
            const double variance = by_cosine ? row.cosine : row.visible_normals;
            if (variance == 0) continue;
            const Weights w = weights(row.alpha, row.mu, by_cosine, 1U << 21U);
            const double change = 0.1 * variance / (1 + variance);
            // the table's four digits
            const double digits = 6e-4 * variance / (1 + variance) + 6e-6;
            EXPECT_TRUE(
                mean_is(w.square, (1 + variance) * row.albedo * row.albedo, 18, change, digits))
                << "alpha " << row.alpha << ", mu " << row.mu << (by_cosine ? ", by cosine" : "");
        }
}

TEST(Ggx, GrazingIsFinite) {
    const std::vector<float> cosines{0, 1e-30F, 1e-20F, 1e-10F, 1e-6F, 1e-3F, 0.5F, 1};
    for (const float alpha : {0.001F, 0.01F, 0.1F, 1.0F})
        for (const float mu_o : cosines)
            for (const float mu_i : cosines) {
                const auto bad = probe().run<cl_uint>("grazing", 256, 5, alpha, mu_o, mu_i);
                for (std::size_t k = 0; k < bad.size(); ++k)
                    EXPECT_EQ(bad[k], 0U)
                        << "value " << k << ", alpha " << alpha << ", " << mu_o << ", " << mu_i;
            }
}

}  // namespace
}  // namespace wavepath
