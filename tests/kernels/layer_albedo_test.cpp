#include "support/probe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace wavepath {
namespace {

const std::string kernels = R"(
// M and B seen under each cosine; below 0: their means
kernel void albedos(
    const uint count, global float* out, const float alpha, global const float* cosines) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    const LayerRows rows = layer_rows(alpha);
    LayerAlbedo a = layer_albedo(rows, cosines[i]);
    if (cosines[i] < 0.0f) a = layer_mean_albedo(rows);
    out[2 * i] = a.missing;
    out[2 * i + 1] = a.grazing;
}
)";

struct Albedo {
    double missing, grazing;
};

std::vector<Albedo> tabulated(float alpha, const std::vector<cl_float>& cosines) {
    static const Probe probe({"materials/layer_albedo.cl"}, kernels);
    const auto out =
        probe.run<cl_float>("albedos", cosines.size(), 2 * cosines.size(), alpha, cosines);
    std::vector<Albedo> all;
    for (std::size_t i = 0; i < cosines.size(); ++i) all.push_back({out[2 * i], out[2 * i + 1]});
    return all;
}

double smith_root(double cosine, double alpha) {
    return std::sqrt(alpha * alpha + (1 - alpha * alpha) * cosine * cosine);
}

// By the map of visible normals that samples them [Dupuy & Benyoub 2023], which the table's own
// quadrature (scripts/layer_albedo.py) knows nothing of: the midpoint rule over the unit square,
// one side cubed to resolve the distribution's tail. Good to some 2e-5.
Albedo quadrature(double mu, double alpha) {
    constexpr int count = 512;
    const double sine = std::sqrt(1 - mu * mu);
    const double length = std::hypot(alpha * sine, mu);
    const double stretched_x = alpha * sine / length;
    const double stretched_z = mu / length;
    const double root = smith_root(mu, alpha);
    Albedo sum{0, 0};
    for (int i = 0; i < count; ++i) {
        const double t = (i + 0.5) / count;
        const double weight = 3 * t * t;
        const double z = t * t * t * (1 + stretched_z) - stretched_z;
        const double r = std::sqrt(std::max(0.0, 1 - z * z));
        for (int j = 0; j < count; ++j) {
            const double phi = std::numbers::pi * (j + 0.5) / count;
            const double x = alpha * (r * std::cos(phi) + stretched_x);
            const double y = alpha * r * std::sin(phi);
            const double h = z + stretched_z;
            const double norm = std::sqrt(x * x + y * y + h * h);
            const double cos_m = (sine * x + mu * h) / norm;
            const double cos_i = 2 * cos_m * h / norm - mu;
            const double kept =
                cos_i <= 0 ? 0
                           : cos_i * (mu + root) / (cos_i * root + mu * smith_root(cos_i, alpha));
            sum.missing += weight * (1 - kept);
            sum.grazing += weight * kept * std::pow(1 - std::min(cos_m, 1.0), 5);
        }
    }
    return {sum.missing / (count * count), sum.grazing / (count * count)};
}

// Exact: bounds of the table's error. Cosines and roughnesses fall between its nodes.
TEST(LayerAlbedo, IsThatOfQuadrature) {
    const std::vector<cl_float> cosines{0.003F, 0.02F, 0.06F, 0.13F, 0.31F,  0.47F,
                                        0.58F,  0.71F, 0.83F, 0.93F, 0.985F, 1};
    double squares = 0;
    std::size_t counted = 0;
    for (const float roughness : {0.045F, 0.07F, 0.12F, 0.19F, 0.33F, 0.47F, 0.61F, 0.78F, 0.99F}) {
        const float alpha = roughness * roughness;
        const std::vector<Albedo> table = tabulated(alpha, cosines);
        for (std::size_t i = 0; i < cosines.size(); ++i) {
            SCOPED_TRACE(testing::Message() << "roughness " << roughness << ", mu " << cosines[i]);
            const Albedo truth = quadrature(double{cosines[i]}, double{alpha});
            const double missing = table[i].missing - truth.missing;
            const double grazing = table[i].grazing - truth.grazing;
            EXPECT_LT(std::abs(missing), 2.5e-4);
            EXPECT_LT(std::abs(grazing), cosines[i] < 0.05F ? 4.5e-4 : 2.5e-4);
            squares += missing * missing + grazing * grazing;
            counted += 2;
        }
    }
    EXPECT_LT(std::sqrt(squares / static_cast<double>(counted)), 1e-4);
}

// So that what is below the layer gets all that the layer leaves.
TEST(LayerAlbedo, MeansAreThoseOfTheProjectedHemisphere) {
    constexpr std::size_t count = 4096;
    std::vector<cl_float> cosines;
    for (std::size_t i = 0; i < count; ++i)
        cosines.push_back((static_cast<float>(i) + 0.5F) / static_cast<float>(count));
    cosines.push_back(-1);
    for (const float roughness : {0.01F, 0.05F, 0.2F, 0.45F, 0.7F, 1.0F}) {
        SCOPED_TRACE(testing::Message() << "roughness " << roughness);
        const std::vector<Albedo> all = tabulated(roughness * roughness, cosines);
        Albedo mean{0, 0};
        for (std::size_t i = 0; i < count; ++i) {
            mean.missing += 2 * all[i].missing * double{cosines[i]} / count;
            mean.grazing += 2 * all[i].grazing * double{cosines[i]} / count;
        }
        EXPECT_NEAR(all.back().missing, mean.missing, 4e-5);
        EXPECT_NEAR(all.back().grazing, mean.grazing, 4e-5);
    }
}

TEST(LayerAlbedo, OfMirrorsIsSchlicks) {
    const std::vector<cl_float> cosines{0, 1e-4F, 0.3F, 0.7F, 1};
    for (const Albedo& a : tabulated(0, {-1})) EXPECT_NEAR(a.grazing, 1.0 / 21, 1e-7);
    const std::vector<Albedo> all = tabulated(0.0009F, cosines);
    for (std::size_t i = 0; i < cosines.size(); ++i) {
        EXPECT_EQ(all[i].missing, 0);
        EXPECT_NEAR(all[i].grazing, std::pow(1 - double{cosines[i]}, 5), 1e-6);
    }
}

// A cosine that is no number reads the table within its bounds; the value is spoilt elsewhere.
TEST(LayerAlbedo, OfNoCosineIsThatOfGrazing) {
    const std::vector<Albedo> all = tabulated(0.25F, {0, NAN, 2});
    EXPECT_EQ(all[0].grazing, all[1].grazing);
    EXPECT_GE(all[2].grazing, 0);
}

}  // namespace
}  // namespace wavepath
