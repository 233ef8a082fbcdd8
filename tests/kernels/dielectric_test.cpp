#include "support/probe.h"
#include "support/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace wavepath {
namespace {

const Probe& probe() {
    static const Probe instance({"materials/dielectric.cl"}, R"(
INLINE Vec3 viewer(const float mu) {
    return vec3(sqrt(1.0f - mu * mu), 0.0f, mu);
}

// over n samples an item, of the flux (a refracted weight times (ior_t / ior_i)^2): the mean; the
// mean of weight * pdf_w - value; the share that is refracted
kernel void samples(
    const uint count, global float* out, const float mu, const float alpha, const float ior_i,
    const float ior_t, const uint n) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    const Vec3 wo = viewer(mu);
    const float scale = ior_t * ior_t / (ior_i * ior_i);
    float flux = 0.0f;
    float difference = 0.0f;
    float refracted = 0.0f;
    for (uint k = 0; k < n; ++k) {
        const Sample2 u = unit_pair(independent_pair(i * n + k, 61));
        const float choice = unit_pair(independent_pair(i * n + k, 62)).u;
        const DielectricSample s = dielectric_sample(wo, alpha, ior_i, ior_t, u, choice);
        const DielectricValue v = dielectric_eval(wo, s.wi, alpha, ior_i, ior_t);
        flux += s.weight * (s.reflects ? 1.0f : scale);
        const float found = s.weight * s.pdf_w;
        difference = max(
            difference, s.weight > 0.0f ? fabs(found - v.value) / max(found, 1e-3f) : 0.0f);
        refracted += s.reflects ? 0.0f : 1.0f;
    }
    out[3 * i] = flux / (float)n;
    out[3 * i + 1] = difference;
    out[3 * i + 2] = refracted / (float)n;
}

// Flux of the value by uniform directions of the sphere, over n an item: reflected and refracted
kernel void integrals(
    const uint count, global float* out, const float mu, const float alpha, const float ior_i,
    const float ior_t, const uint n) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    const float scale = ior_t * ior_t / (ior_i * ior_i);
    float sums[3] = {0.0f, 0.0f, 0.0f};
    for (uint k = 0; k < n; ++k) {
        const Vec3 wi = sample_sphere(unit_pair(independent_pair(i * n + k, 63)));
        const DielectricValue v = dielectric_eval(viewer(mu), wi, alpha, ior_i, ior_t);
        sums[wi.z > 0.0f ? 0 : 1] += 4.0f * PI_F * v.value * (wi.z > 0.0f ? 1.0f : scale);
        sums[2] += 4.0f * PI_F * v.pdf_w;
    }
    for (int k = 0; k < 3; ++k) out[3 * i + k] = sums[k] / (float)n;
}
)");
    return instance;
}

constexpr std::size_t items = 4096;

Moments column(const std::vector<float>& out, std::size_t k) {
    Moments moments;
    for (std::size_t i = 0; i < out.size() / 3; ++i) moments.add(out[3 * i + k]);
    return moments;
}

// What is reflected and refracted is all there is, but for what single scattering between facets
// loses: little where they are steep nowhere.
TEST(RoughDielectric, ReflectsAndRefractsAllLightWhereFacetsAreFlat) {
    for (const auto& [ior_i, ior_t] : {std::pair{1.0F, 1.5F}, std::pair{1.5F, 1.0F}})
        for (const float mu : {1.0F, 0.8F}) {
            const auto out =
                probe().run<float>("samples", items, 3 * items, mu, 0.02F, ior_i, ior_t, 64U);
            EXPECT_NEAR(column(out, 0).mean(), 1, 2e-3) << mu << ", " << ior_i;
        }
}

// Samples against uniform directions: values, densities and their integrals.
TEST(RoughDielectric, SamplesFollowItsValues) {
    for (const auto& [ior_i, ior_t] : {std::pair{1.0F, 1.5F}, std::pair{1.5F, 1.0F}})
        for (const float mu : {0.9F, 0.4F}) {
            SCOPED_TRACE(testing::Message() << mu << ", " << ior_i);
            constexpr float alpha = 0.4F;
            const auto drawn =
                probe().run<float>("samples", items, 3 * items, mu, alpha, ior_i, ior_t, 64U);
            const auto integrals =
                probe().run<float>("integrals", items, 3 * items, mu, alpha, ior_i, ior_t, 2048U);
            constexpr double z = 5.5;
            const Moments flux = column(drawn, 0);
            const Moments reflected = column(integrals, 0);
            const Moments refracted = column(integrals, 1);
            EXPECT_NEAR(
                flux.mean(), reflected.mean() + refracted.mean(),
                z * std::hypot(
                        flux.standard_error(), reflected.standard_error(),
                        refracted.standard_error()));
            EXPECT_LT(refracted.standard_error(), 0.003 * flux.mean());
            EXPECT_LT(flux.mean(), 1.0001);
            // directions that facets send to the wrong side count in no density
            EXPECT_LT(column(integrals, 2).mean(), 1.005);
            EXPECT_LT(column(drawn, 1).mean(), 1e-3);
        }
}

}  // namespace
}  // namespace wavepath
