#include "support/grid.h"
#include "support/probe.h"
#include "support/statistics.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace wavepath {
namespace {

using std::numbers::pi;

const Grid grid;

const std::string kernels = R"(
INLINE Vec3 viewer(const float mu) {
    return vec3(sqrt(1.0f - mu * mu), 0.0f, mu);
}

// base, f0, metallic, specular, alpha
INLINE Surface surface_of(global const float* p) {
    Surface s;
    s.base = load3(p, 1, 0);
    s.f0 = load3(p + 3, 1, 0);
    s.metallic = p[6];
    s.specular = p[7];
    s.alpha = p[8];
    s.transmission = 0.0f;
    return s;
}

INLINE BsdfSample sample_of(const Surface s, const Vec3 wo, const uint i) {
    return gltf_sample(
        s, wo, unit_pair(independent_pair(i, 31)), unit_float(independent_pair(i, 32).u));
}

// the hemisphere of wi: x = z, y = azimuth
kernel void directions(
    const uint count, global uint* out, global const float* material, const float mu) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    const Vec3 wi = sample_of(surface_of(material), viewer(mu), i).wi;
    grid_count(out, wi.z > 0.0f ? wi.z : -1.0f, atan2(wi.y, wi.x) * (0.5f * INV_PI_F) + 0.5f);
}

kernel void densities(
    const uint count, global float* out, global const float* material, const float mu,
    global const float* wi) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    out[i] = gltf_pdf_w(
        surface_of(material), viewer(mu), vec3(wi[3 * i], wi[3 * i + 1], wi[3 * i + 2]), 0);
}

// means of the weight's three channels over n samples an item
kernel void albedos(
    const uint count, global float* out, global const float* material, const float mu,
    const uint n) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    Vec3 sum = vec3(0.0f, 0.0f, 0.0f);
    for (uint k = 0; k < n; ++k)
        sum = add3(sum, sample_of(surface_of(material), viewer(mu), i * n + k).weight);
    store3(out + 3 * i, 1, 0, scale3(sum, 1.0f / (float)n));
}

// how many samples break a rule: pdf_w is gltf_pdf_w; weight * pdf_w = f cos; reciprocity; values finite and >= 0
kernel void breaches(
    const uint count, global uint* out, global const float* material, const float mu) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    const Surface s = surface_of(material);
    const Vec3 wo = viewer(mu);
    const BsdfSample b = sample_of(s, wo, i);
    const Vec3 value = gltf_eval(s, wo, b.wi, 0);
    const Vec3 product = scale3(b.weight, b.pdf_w);
    if (b.pdf_w != gltf_pdf_w(s, wo, b.wi, 0)) atomic_inc(out);
    if (!(max_component3(value) < INFINITY && b.pdf_w < INFINITY)) atomic_inc(out + 1);
    if (!(min(min(b.weight.x, b.weight.y), b.weight.z) >= 0.0f && b.pdf_w >= 0.0f)) atomic_inc(out + 1);
    if (!(fabs(product.x - value.x) <= 1e-6f * value.x + 1e-30f)) atomic_inc(out + 2);
    if (!(fabs(product.z - value.z) <= 1e-6f * value.z + 1e-30f)) atomic_inc(out + 2);
    if (b.wi.z > 0.0f && mu >= 0.05f) {  // at grazing angles 1 - F cancels
        const float there = value.y * wo.z;
        const float back = gltf_eval(s, b.wi, wo, 0).y * b.wi.z;
        if (!(fabs(there - back) <= 1e-4f * there + 1e-30f)) atomic_inc(out + 3);
    }
    if (!(fabs(dot3(b.wi, b.wi) - 1.0f) < 2e-6f)) atomic_inc(out + 4);
}

// a mirror: mean weight of certain directions, their share, and how many of them are not the mirror direction
kernel void mirrors(
    const uint count, global float* out, global const float* material, const float mu) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    const Vec3 wo = viewer(mu);
    const BsdfSample b = sample_of(surface_of(material), wo, i);
    const Vec3 off = sub3(b.wi, vec3(-wo.x, -wo.y, wo.z));
    const int certain = b.pdf_w == PDF_CERTAIN;
    out[3 * i] = certain ? b.weight.x : 0.0f;
    out[3 * i + 1] = certain ? 1.0f : 0.0f;
    out[3 * i + 2] = certain ? dot3(off, off) : 0.0f;
}
)";

Probe make_probe(const std::string& defines) {
    return Probe({"materials/gltf_material.cl"}, grid_functions(grid) + kernels, defines);
}

const Probe& probe() {
    static const Probe instance = make_probe("");
    return instance;
}

// By the letter of glTF, which gains energy.
const Probe& letter() {
    static const Probe instance = make_probe("#define LAYERS_CONSERVE 0\n");
    return instance;
}

// In the order of surface_of; base and f0 by channel.
std::vector<cl_float> material(
    std::array<float, 3> base,
    float metallic,
    float roughness,
    float f0 = 0.04F,
    float specular = 1) {
    return {base[0], base[1], base[2], f0, f0, f0, metallic, specular, roughness * roughness};
}

struct Case {
    std::vector<cl_float> material;
    float mu;
};

std::vector<Case> cases() {
    return {
        {material({0.5F, 0.5F, 0.5F}, 0, 0.5F), 0.5F},
        {material({0.8F, 0.2F, 0.1F}, 0, 0.4F), 0.1F},
        {material({1, 0.7F, 0.3F}, 1, 0.4F), 0.7F},
        {material({0.9F, 0.9F, 0.9F}, 1, 0.6F), 0.05F},
        {material({0.9F, 0.5F, 0.1F}, 0.5F, 0.5F, 0.08F, 0.5F), 0.3F},
        {material({0, 0, 0}, 0, 1), 1},
        {material({0.7F, 0.7F, 0.7F}, 0, 0.3F, 1), 0.9F},
        {material({0.7F, 0.7F, 0.7F}, 0, 0.3F, 0.04F, 0), 0.6F}};
}

// alpha: false_alarm over the cases' pairs of grids; power in support/grid.h.
TEST(GltfMaterial, DirectionsFollowTheirDensity) {
    const std::vector<Case> all = cases();
    std::vector<cl_float> nodes;
    for (const auto& [z, y] : grid_nodes(grid)) {
        const double r = std::sqrt(1 - z * z);
        const double phi = 2 * pi * (y - 0.5);
        for (const double c : {r * std::cos(phi), r * std::sin(phi), z})
            nodes.push_back(static_cast<cl_float>(c));
    }
    for (std::size_t k = 0; k < all.size(); ++k) {
        SCOPED_TRACE(testing::Message() << "case " << k);
        const auto& [surface, mu] = all[k];
        for (const Probe* tested : {&probe(), &letter()}) {
            const auto pdfs = tested->run<cl_float>(
                "densities", nodes.size() / 3, nodes.size() / 3, surface, mu, nodes);
            std::vector<double> densities(pdfs.begin(), pdfs.end());
            for (double& density : densities) density *= 2 * pi;
            expect_distribution(
                grid,
                tested->run<cl_uint>(
                    "directions", scaled(1U << 21U), grid.cells() + 1, surface, mu),
                grid_probabilities(grid, densities), 2 * all.size());
        }
    }
}

// Exact: bounds of rounding.
TEST(GltfMaterial, SamplesKeepTheirContract) {
    std::vector<Case> all = cases();
    for (const float roughness : {0.04F, 0.1F, 1.0F})
        for (const float mu : {0.0F, 1e-30F, 1e-6F, 1e-3F})
            all.push_back({material({0.9F, 0.5F, 0.1F}, 0.5F, roughness), mu});
    const std::vector<std::string> rules{
        "pdf_w = gltf_pdf_w(wi)", "finite and >= 0", "weight = f cos / pdf_w", "reciprocity",
        "unit wi"};
    for (std::size_t k = 0; k < all.size(); ++k) {
        for (const Probe* tested : {&probe(), &letter()}) {
            const auto breaches = tested->run<cl_uint>(
                "breaches", scaled(1U << 16U), rules.size(), all[k].material, all[k].mu);
            for (std::size_t rule = 0; rule < rules.size(); ++rule)
                EXPECT_EQ(breaches[rule], 0U) << "case " << k << ": " << rules[rule];
        }
    }
}

struct AlbedoRow {
    float roughness, mu;
    double dielectric, grey_dielectric, metal, grey_metal;  // base 1 and 1/2
};

void expect_albedos(
    const Probe& tested, const AlbedoRow& row, std::size_t comparisons, double tolerance = 1e-5) {
    constexpr std::size_t batches = 512;
    const auto n = static_cast<cl_uint>(scaled(2304));
    for (const bool metal : {false, true}) {
        const auto out = tested.run<cl_float>(
            "albedos", batches, 3 * batches,
            material({1, 0.5F, 0}, metal ? 1.0F : 0.0F, row.roughness), row.mu, n);
        for (std::size_t channel = 0; channel < 2; ++channel) {
            Moments moments;
            for (std::size_t i = 0; i < batches; ++i) moments.add(out[3 * i + channel]);
            const double truth = metal ? (channel == 0 ? row.metal : row.grey_metal)
                                       : (channel == 0 ? row.dielectric : row.grey_dielectric);
            EXPECT_TRUE(mean_is(moments, truth, comparisons, 0.01, tolerance))
                << (metal ? "metal" : "dielectric") << " of roughness " << row.roughness << ", mu "
                << row.mu << ", channel " << channel;
        }
    }
}

const std::vector<AlbedoRow> albedo_rows{
    {0.1F, 1, .999917, .519957, .999898, .499949},
    {0.1F, 0.5F, 1.025378, .547758, .999742, .515573},
    {0.1F, 0.2F, 1.297428, .824779, .998587, .661891},
    {0.3F, 1, .999553, .519593, .990665, .495335},
    {0.3F, 0.5F, 1.025359, .547739, .975089, .503750},
    {0.3F, 0.2F, 1.198276, .725627, .914026, .569731},
    {0.5F, 1, .996580, .516620, .915814, .457921},
    {0.5F, 0.5F, 1.010985, .533365, .857263, .439805},
    {0.5F, 0.2F, 1.073558, .600909, .848160, .473212},
    {0.7F, 1, .987876, .507916, .697750, .348898},
    {0.7F, 0.5F, .993436, .515816, .703974, .357214},
    {0.7F, 0.2F, 1.017525, .544877, .792716, .417462},
    {1, 1, .972228, .492267, .306853, .153444},
    {1, 0.5F, .976138, .498518, .450694, .226841},
    {1, 0.2F, .984430, .511781, .641648, .327838}};

// Uniform environment of radiance 1: what a point reflects. By quadrature to 3e-6; glTF's
// dielectric exceeds 1 by specification. alpha: false_alarm over 60 means, a bias of 1 % found with
// probability .99.
TEST(GltfMaterial, DirectionalAlbedo) {
    for (const AlbedoRow& row : albedo_rows) expect_albedos(letter(), row, 4 * albedo_rows.size());
}

// The same where layers conserve: 1 for a white base. The specular part E follows from the letter's
// rows, which are linear in the base, and a base of a half reflects half of 1 - E.
TEST(GltfMaterial, DirectionalAlbedoOfLayersThatConserve) {
    for (AlbedoRow row : albedo_rows) {
        const double specular = 2 * row.grey_dielectric - row.dielectric;
        row.dielectric = 1;
        row.grey_dielectric = (1 + specular) / 2;
        expect_albedos(probe(), row, 4 * albedo_rows.size(), 4e-4);
    }
}

// The same numbers from cosine-distributed directions (SAMPLE_LOBES 0), where the lobe is wide
// enough for them.
TEST(GltfMaterial, DirectionalAlbedoByCosine) {
    const Probe by_cosine = make_probe("#define SAMPLE_LOBES 0\n#define LAYERS_CONSERVE 0\n");
    for (const AlbedoRow& row : albedo_rows)
        if (row.roughness >= 0.7F) expect_albedos(by_cosine, row, 24);
}

// No specular lobe anywhere in the scene: the program without it is Lambert's reflector.
TEST(GltfMaterial, WithoutSpecularLobes) {
    const Probe lambert = make_probe("#define HAS_SPECULAR 0\n");
    const auto surface = material({0.75F, 0.5F, 0.25F}, 1, 0.3F);
    const auto out = lambert.run<cl_float>("albedos", 64, 192, surface, 0.5F, cl_uint{16});
    for (std::size_t i = 0; i < out.size(); ++i)
        EXPECT_FLOAT_EQ(out[i], surface[i % 3]) << "weight is the albedo, exactly";
    for (const cl_uint breaches : lambert.run<cl_uint>("breaches", 4096, 5, surface, 0.5F))
        EXPECT_EQ(breaches, 0U);
}

// Below MIRROR_ALPHA: a delta whose weight times its chance is the Fresnel reflectance. alpha:
// false_alarm over 4 shares; a metal's share is 1.
TEST(GltfMaterial, SmoothSurfacesAreMirrors) {
    const std::size_t samples = scaled(1U << 16U);
    for (const float metallic : {0.0F, 1.0F})
        for (const float mu : {1.0F, 0.2F}) {
            const auto out = probe().run<cl_float>(
                "mirrors", samples, 3 * samples, material({0.5F, 0.5F, 0.5F}, metallic, 0.03F), mu);
            Moments weight;
            for (std::size_t i = 0; i < samples; ++i) {
                weight.add(out[3 * i]);
                EXPECT_LT(out[3 * i + 2], 1e-12F);
                if (metallic == 1) {
                    EXPECT_EQ(out[3 * i + 1], 1.0F);
                }
            }
            const double f0 = metallic == 1 ? 0.5 : 0.04;
            const double reflectance = f0 + (1 - f0) * std::pow(1 - double{mu}, 5);
            EXPECT_TRUE(samples < 128 || mean_is(weight, reflectance, 4)) << metallic << ' ' << mu;
        }
}

}  // namespace
}  // namespace wavepath
