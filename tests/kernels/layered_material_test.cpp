// What lies below the specular layer, and the lobes through thin walls, of gltf_material.cl.
#include "support/grid.h"
#include "support/probe.h"
#include "support/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace wavepath {
namespace {

const Grid grid;

const std::string kernels = R"(
// base, f0, specular weight, alpha, transmission
INLINE Surface surface_of(global const float* p) {
    Surface s;
    s.base = vec3(p[0], p[0], p[0]);
    s.f0 = vec3(p[1], p[1], p[1]);
    s.metallic = 0.0f;
    s.specular = p[2];
    s.alpha = p[3];
    s.transmission = p[4];
    return s;
}

INLINE Vec3 viewer(const float mu) {
    return vec3(sqrt(1.0f - mu * mu), 0.0f, mu);
}

INLINE BsdfSample sample_of(const Surface s, const Vec3 wo, const uint i) {
    return gltf_sample(
        s, wo, unit_pair(independent_pair(i, 31)), unit_float(independent_pair(i, 32).u));
}

// mean weights of what is reflected and of what goes through, over n samples an item
kernel void albedos(
    const uint count, global float* out, global const float* material, const float mu,
    const uint n) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    float above = 0.0f;
    float below = 0.0f;
    for (uint k = 0; k < n; ++k) {
        const BsdfSample b = sample_of(surface_of(material), viewer(mu), i * n + k);
        above += b.through ? 0.0f : b.weight.x;
        below += b.through ? b.weight.x : 0.0f;
    }
    out[2 * i] = above / (float)n;
    out[2 * i + 1] = below / (float)n;
}

// the hemisphere behind: x = -z, y = azimuth
kernel void directions(
    const uint count, global uint* out, global const float* material, const float mu) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    const BsdfSample b = sample_of(surface_of(material), viewer(mu), i);
    grid_count(
        out, b.through && b.wi.z < 0.0f ? -b.wi.z : -1.0f,
        atan2(b.wi.y, b.wi.x) * (0.5f * INV_PI_F) + 0.5f);
}

kernel void densities(
    const uint count, global float* out, global const float* material, const float mu,
    global const float* wi) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    out[i] = gltf_pdf_w(
        surface_of(material), viewer(mu),
        vec3(wi[3 * i], wi[3 * i + 1], wi[3 * i + 2]), 1);
}

// how many samples break a rule: weight * pdf_w = f cos; pdf_w is gltf_pdf_w; reciprocity
kernel void breaches(
    const uint count, global uint* out, global const float* material, const float mu) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    const Surface s = surface_of(material);
    const Vec3 wo = viewer(mu);
    const BsdfSample b = sample_of(s, wo, i);
    const Vec3 wi = b.through ? through_wall(b.wi) : b.wi;
    const float value = gltf_eval(s, wo, wi, b.through).x;
    if (!(fabs(b.weight.x * b.pdf_w - value) <= 1e-6f * value + 1e-30f)) atomic_inc(out);
    if (b.pdf_w != gltf_pdf_w(s, wo, wi, b.through)) atomic_inc(out + 1);
    const float there = value * wo.z;
    const float back = gltf_eval(s, wi, wo, b.through).x * wi.z;
    if (wi.z > 0.0f && !(fabs(there - back) <= 1e-4f * there + 1e-30f)) atomic_inc(out + 2);
}
)";

const Probe& probe() {
    static const Probe instance({"materials/gltf_material.cl"}, grid_functions(grid) + kernels);
    return instance;
}

// In the order of surface_of.
std::vector<cl_float> material(
    float base, float roughness, float transmission, float f0 = 0.04F, float specular = 1) {
    return {base, f0, specular, roughness * roughness, transmission};
}

struct Case {
    float roughness, transmission, mu;
};

std::vector<Case> cases() {
    std::vector<Case> all;
    for (const float roughness : {0.2F, 0.5F, 0.8F, 1.0F})
        for (const float transmission : {1.0F, 0.6F})
            for (const float mu : {0.15F, 0.5F, 0.95F})
                all.push_back({roughness, transmission, mu});
    return all;
}

// Mean weights: reflected, through, both.
std::vector<Moments> albedos(const std::vector<cl_float>& surface, float mu) {
    constexpr std::size_t batches = 512;
    const auto out = probe().run<cl_float>(
        "albedos", batches, 2 * batches, surface, mu, static_cast<cl_uint>(scaled(1024)));
    std::vector<Moments> sides(3);
    for (std::size_t i = 0; i < batches; ++i) {
        sides[0].add(out[2 * i]);
        sides[1].add(out[2 * i + 1]);
        sides[2].add(out[2 * i] + out[2 * i + 1]);
    }
    return sides;
}

// Opaque, of any index and specular weight, at any roughness and angle. alpha: false_alarm over 84
// means; the table of albedos is right to 5e-4.
TEST(LayeredMaterial, WhiteDielectricsReflectAll) {
    for (const auto& [f0, specular] :
         {std::pair{0.04F, 1.0F}, {0.04F, 0.4F}, {0.25F, 1.0F}, {1.0F, 1.0F}})
        for (const float roughness : {0.03F, 0.06F, 0.15F, 0.4F, 0.65F, 0.85F, 1.0F})
            for (const float mu : {0.04F, 0.25F, 0.8F}) {
                SCOPED_TRACE(
                    testing::Message() << "f0 " << f0 << ", specular " << specular << ", roughness "
                                       << roughness << ", mu " << mu);
                const Moments all = albedos(material(1, roughness, 0, f0, specular), mu)[2];
                EXPECT_TRUE(mean_is(all, 1, 84, 0.01, 5e-4));
            }
}

// All light leaves on one side or the other; of what the layer lets in the share `transmission`
// goes through. alpha: false_alarm over 24 means; 6 standard errors for the share.
TEST(LayeredMaterial, WhiteWallsLoseNothing) {
    for (const Case& c : cases()) {
        SCOPED_TRACE(
            testing::Message() << "roughness " << c.roughness << ", transmission " << c.transmission
                               << ", mu " << c.mu);
        const auto white = albedos(material(1, c.roughness, c.transmission), c.mu);
        const auto black = albedos(material(0, c.roughness, c.transmission), c.mu);
        EXPECT_TRUE(mean_is(white[2], 1, 24, 0.01, 5e-4));
        EXPECT_EQ(black[1].mean(), 0);
        const double chance = 6 * std::hypot(white[1].standard_error(), black[0].standard_error());
        EXPECT_NEAR(white[1].mean(), c.transmission * (1 - black[0].mean()), chance + 5e-4);
    }
}

TEST(LayeredMaterial, DirectionsBehindFollowTheirDensity) {
    std::vector<cl_float> nodes;
    for (const auto& [z, y] : grid_nodes(grid)) {
        const double r = std::sqrt(1 - z * z);
        const double phi = 2 * std::numbers::pi * (y - 0.5);
        for (const double c : {r * std::cos(phi), r * std::sin(phi), z})
            nodes.push_back(static_cast<cl_float>(c));
    }
    const std::vector<Case> all{{0.5F, 0.6F, 0.4F}, {0.9F, 1, 0.2F}, {0.8F, 0.3F, 0.9F}};
    for (const Case& c : all) {
        const auto surface = material(1, c.roughness, c.transmission);
        const auto pdfs = probe().run<cl_float>(
            "densities", nodes.size() / 3, nodes.size() / 3, surface, c.mu, nodes);
        std::vector<double> densities(pdfs.begin(), pdfs.end());
        for (double& density : densities) density *= 2 * std::numbers::pi;
        expect_distribution(
            grid,
            probe().run<cl_uint>("directions", scaled(1U << 21U), grid.cells() + 1, surface, c.mu),
            grid_probabilities(grid, densities), all.size());
    }
}

// Exact: bounds of rounding.
TEST(LayeredMaterial, SamplesKeepTheirContract) {
    const std::vector<std::string> rules{"weight = f cos / pdf_w", "pdf_w", "reciprocity"};
    for (const Case& c : cases()) {
        const auto breaches = probe().run<cl_uint>(
            "breaches", scaled(1U << 16U), rules.size(),
            material(0.8F, c.roughness, c.transmission), c.mu);
        for (std::size_t rule = 0; rule < rules.size(); ++rule)
            EXPECT_EQ(breaches[rule], 0U)
                << rules[rule] << ", roughness " << c.roughness << ", mu " << c.mu;
    }
}

}  // namespace
}  // namespace wavepath
