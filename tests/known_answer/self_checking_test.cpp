// Sample models that check themselves: a patch shows what it tests beside one that shows what it
// should be. Places are pixels of a picture of 512 x 512, seen as the published ones are.
#include "gltf/gltf_loader.h"
#include "support/rendering.h"
#include "support/sample_files.h"

#include <array>
#include <cmath>
#include <numbers>

namespace wavepath {
namespace {

constexpr uint32_t size = 512;
using Colour = std::array<double, 3>;

struct Patch {
    uint32_t x, y;  // its middle
    uint32_t half;  // pixels to either side of it
};

class Picture {
  public:
    Picture(const std::filesystem::path& model, double distance) {
        Scene scene = load_gltf(model);
        scene.environment = constant_environment(1);
        RenderSettings settings = square_settings(
            "mis", perspective({0, 0, distance}, {0, 0, 0}, std::numbers::pi / 4), size, 8);
        settings.termination = {TerminationKind::depth, 1, 1};
        channels_ = render_scene(scene, settings).film.image.channels;
    }

    // Mean of three channels, by their common beginning: "albedo.", "normal.", "".
    Colour mean(const std::string& layer, const Patch& patch) const {
        Colour sums{};
        const auto planes = layers(layer);
        for (std::size_t c = 0; c < 3; ++c) {
            for (const float x : values(*planes[c], patch)) sums[c] += x;
            sums[c] /= std::pow(2.0 * patch.half + 1, 2);
        }
        return sums;
    }

    // Least correlation, among the axes of the normal, of two patches pixel by pixel.
    double likeness_of_normals(const Patch& a, const Patch& b) const {
        double least = 1;
        for (const std::vector<float>* plane : layers("normal.")) {
            const auto x = values(*plane, a);
            const auto y = values(*plane, b);
            const auto n = static_cast<double>(x.size());
            double sx = 0, sy = 0, sxx = 0, syy = 0, sxy = 0;
            for (std::size_t i = 0; i < x.size(); ++i) {
                sx += x[i];
                sy += y[i];
                sxx += double{x[i]} * x[i];
                syy += double{y[i]} * y[i];
                sxy += double{x[i]} * y[i];
            }
            least = std::min(
                least, (n * sxy - sx * sy) / std::sqrt((n * sxx - sx * sx) * (n * syy - sy * sy)));
        }
        return least;
    }

  private:
    std::array<const std::vector<float>*, 3> layers(const std::string& layer) const {
        const std::string axes = layer == "normal." ? "XYZ" : "RGB";
        return {
            &channels_.at(layer + axes[0]), &channels_.at(layer + axes[1]),
            &channels_.at(layer + axes[2])};
    }

    static std::vector<float> values(const std::vector<float>& plane, const Patch& patch) {
        std::vector<float> found;
        for (uint32_t y = patch.y - patch.half; y <= patch.y + patch.half; ++y)
            for (uint32_t x = patch.x - patch.half; x <= patch.x + patch.half; ++x)
                found.push_back(plane[std::size_t{size} * y + x]);
        return found;
    }

    std::map<std::string, std::vector<float>> channels_;
};

double farthest(const Colour& a, const Colour& b) {
    double most = 0;
    for (std::size_t c = 0; c < 3; ++c) most = std::max(most, std::abs(a[c] - b[c]));
    return most;
}

// A check mark and a cross differ by .25 in the mean; edges of patches, by up to .03.
constexpr double alike = 0.06;

class SelfChecking : public testing::Test {
  protected:
    void SetUp() override {
        if (asset_folder().empty()) GTEST_SKIP() << "no sample models";
    }

    static Picture picture(const std::string& model, double distance) {
        return {asset_folder() / "models" / model, distance};
    }
};

// The back of a single-sided face is not culled (docs/textures.md): that row shows its cross.
TEST_F(SelfChecking, TextureSettings) {
    const Picture seen = picture("TextureSettingsTest/TextureSettingsTest.glb", 15);
    constexpr uint32_t rows[] = {151, 193, 236, 279, 322, 364, 407, 450};
    for (const uint32_t y : rows) {
        const double off =
            farthest(seen.mean("albedo.", {275, y, 13}), seen.mean("albedo.", {363, y, 13}));
        if (y == rows[0])
            EXPECT_GT(off, 2 * alike);
        else
            EXPECT_LT(off, alike) << y;
    }
}

// Fronts, and balls whose node mirrors them: smooth normals of either are like a ball's. Backs are
// not culled, as above.
TEST_F(SelfChecking, NegativeScale) {
    const Picture seen = picture("NegativeScaleTest/NegativeScaleTest.glb", 13);
    for (const uint32_t y : {128U, 184U}) {
        const Colour sample = seen.mean("albedo.", {438, y, 15});
        EXPECT_LT(farthest(seen.mean("albedo.", {256, y, 15}), sample), alike) << y;
        EXPECT_GT(farthest(seen.mean("albedo.", {346, y, 15}), sample), 2 * alike) << y;
    }
    for (const uint32_t y : {303U, 363U, 426U})
        EXPECT_GT(seen.likeness_of_normals({303, y, 14}, {401, y, 14}), 0.98) << y;
}

// Bumps of a map beside the same of geometry: five turns of three materials.
TEST_F(SelfChecking, NormalTangent) {
    const Picture seen = picture("NormalTangentTest/NormalTangentTest.glb", 4.25);
    for (const uint32_t y : {139U, 198U, 256U, 314U, 372U})
        for (const uint32_t x : {116U, 232U, 348U})
            EXPECT_GT(seen.likeness_of_normals({x, y, 18}, {x + 47, y, 18}), 0.88)
                << x << ", " << y;
}

// Above, the tiles of offsets that are right are green, blue and cyan; below, the arrow's tip
// points at the check mark where offset, rotation and scale are right.
TEST_F(SelfChecking, TextureTransform) {
    const Picture seen = picture("TextureTransformTest/TextureTransformTest.gltf", 4);
    const std::pair<uint32_t, Colour> tiles[] = {
        {86, {0, 0.527, 0}}, {256, {0, 0, 0.527}}, {426, {0, 0.527, 0.527}}};
    for (const auto& [x, colour] : tiles)
        EXPECT_LT(farthest(seen.mean("albedo.", {x - 60, 110, 8}), colour), 0.01) << x;
    const Patch tips[] = {{64, 388, 3}, {243, 328, 3}, {408, 358, 3}};
    for (const Patch& tip : tips) EXPECT_LT(seen.mean("albedo.", tip)[0], 0.1) << tip.x;
    // and no tip at a "not supported"
    EXPECT_GT(seen.mean("albedo.", {115, 365, 5})[0], 0.3);
    EXPECT_GT(seen.mean("albedo.", {285, 365, 5})[0], 0.3);
}

// The logo shows on the plane by the second set of coordinates.
TEST_F(SelfChecking, MultiUV) {
    const Picture seen = picture("MultiUVTest/MultiUVTest.glb", 4.25);
    const Colour logo = seen.mean("", {228, 194, 4});
    const Colour plane = seen.mean("", {130, 130, 8});
    EXPECT_GT(logo[1], logo[0] + 0.1);
    EXPECT_GT(logo[1], plane[1] + 0.2);
    EXPECT_LT(std::abs(plane[1] - 0.93 * plane[0]), 0.1);
}

}  // namespace
}  // namespace wavepath
