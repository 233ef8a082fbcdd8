#include "gltf/gltf_medium.h"

#include "support/gltf_media.h"

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <string>

namespace wavepath {
namespace {

using Json = GltfBuilder::Json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(GltfMedium, ReadsPhysicalCoefficients) {
    const Scene scene = load(file_with(with_extras(
        {{"sigma_a", {0.5, 1, 2}},
         {"sigma_s", {3, 0, 4}},
         {"g", -0.25},
         {"emission", {1, 2, 3}}})));
    const Material& material = scene.materials[0];
    EXPECT_EQ(material.boundary, Boundary::index_matched);
    EXPECT_THAT(material.medium.sigma_a, ElementsAre(0.5F, 1, 2));
    EXPECT_THAT(material.medium.sigma_s, ElementsAre(3, 0, 4));
    EXPECT_THAT(material.medium.emission, ElementsAre(1, 2, 3));
    EXPECT_EQ(material.medium.anisotropy, -0.25F);
    EXPECT_THAT(scene.ignored, IsEmpty());
}

TEST(GltfMedium, ReadsAttenuation) {
    Json material = boundary();
    material["extensions"]["KHR_materials_volume"]["attenuationColor"] = {0.5, 1, 0};
    material["extensions"]["KHR_materials_volume"]["attenuationDistance"] = 2;
    const Medium medium = load(file_with(material)).materials[0].medium;
    EXPECT_FLOAT_EQ(medium.sigma_a[0], static_cast<float>(std::log(2) / 2));
    EXPECT_EQ(medium.sigma_a[1], 0);
    EXPECT_GT(medium.sigma_a[2], 40);
    EXPECT_FALSE(medium.scatters());
    // the extras win
    material["extras"] = {{"wavepath_medium", {{"sigma_a", {1, 1, 1}}}}};
    EXPECT_THAT(load(file_with(material)).materials[0].medium.sigma_a, ElementsAre(1, 1, 1));
}

// Single-scattering albedos of multi-scatter albedos .1, .5, .9: by either draft.
TEST(GltfMedium, ReadsScatterDrafts) {
    const auto albedos = [](const std::string& extension, const Json& scatter) {
        Json material = boundary();
        attenuate(material);
        material["extensions"][extension] = scatter;
        const Medium medium = load(file_with(material)).materials[0].medium;
        EXPECT_EQ(medium.anisotropy, scatter.value("scatterAnisotropy", 0.0F));
        std::array<double, 3> albedo{};
        for (std::size_t c = 0; c < 3; ++c) {
            const double sigma_t = medium.sigma_a[c] + medium.sigma_s[c];
            EXPECT_NEAR(sigma_t, std::log(2) / 2, 1e-6);
            albedo[c] = medium.sigma_s[c] / sigma_t;
        }
        return albedo;
    };
    const auto near = [](double a, double b, double c) {
        return ElementsAre(
            testing::DoubleNear(a, 2e-6), testing::DoubleNear(b, 2e-6),
            testing::DoubleNear(c, 2e-6));
    };
    for (const char* key : {"multiscatterColorFactor", "multiscatterColor", "scatterAlbedo"})
        EXPECT_THAT(
            albedos("KHR_materials_volume_scatter", {{key, {0.1, 0.5, 0.9}}}),
            near(.384240, .911709, .997907));
    // the older draft does not know the anisotropy; its colour is black by default
    EXPECT_THAT(
        albedos(
            "KHR_materials_volume_scatter",
            {{"multiscatterColor", {0.1, 0.5, 0.9}}, {"scatterAnisotropy", 0.5}}),
        near(.384240, .911709, .997907));
    EXPECT_THAT(albedos("KHR_materials_volume_scatter", Json::object()), near(0, 0, 0));
    // the newer one's is white, and is scaled
    EXPECT_THAT(albedos("KHR_materials_scatter", {{"scatterStrengthFactor", 1}}), near(1, 1, 1));
    EXPECT_THAT(
        albedos(
            "KHR_materials_scatter",
            {{"scatterStrengthFactor", 0.5}, {"multiscatterColorFactor", {0.2, 1, 1.8}}}),
        near(.384240, .911709, .997907));
    EXPECT_THAT(
        albedos(
            "KHR_materials_scatter", {{"scatterStrengthFactor", 1},
                                      {"multiscatterColorFactor", {0.1, 0.5, 0.9}},
                                      {"scatterAnisotropy", 0.5}}),
        near(.555164, .953816, .998952));
    EXPECT_THAT(albedos("KHR_materials_scatter", Json::object()), near(0, 0, 0));
}

// The extras over all, the newer draft over the older, in one draft the latest name.
TEST(GltfMedium, TakesTheNewestOfSeveral) {
    const auto albedo = [](const Json& material) {
        const Medium medium = load(file_with(material)).materials[0].medium;
        return medium.sigma_s[0] / (medium.sigma_a[0] + medium.sigma_s[0]);
    };
    Json material = boundary();
    attenuate(material);
    Json& extensions = material["extensions"];
    Json& older = extensions["KHR_materials_volume_scatter"];
    older = {{"scatterAlbedo", {0.9, 0.9, 0.9}}};
    EXPECT_NEAR(albedo(material), .997907, 2e-6);
    older["multiscatterColor"] = {0.5, 0.5, 0.5};
    EXPECT_NEAR(albedo(material), .911709, 2e-6);
    older["multiscatterColorFactor"] = {0.1, 0.1, 0.1};
    EXPECT_NEAR(albedo(material), .384240, 2e-6);
    extensions["KHR_materials_scatter"] = {
        {"scatterStrengthFactor", 1}, {"multiscatterColorFactor", {0.5, 0.5, 0.5}}};
    EXPECT_NEAR(albedo(material), .911709, 2e-6);
    material["extras"] = {{"wavepath_medium", {{"sigma_a", {1, 1, 1}}, {"sigma_s", {3, 3, 3}}}}};
    EXPECT_EQ(albedo(material), 0.75F);
}

TEST(GltfMedium, ReadsVolumesThatTransmitInPart) {
    const struct {
        const char* path;
        Json value;
    } cases[] = {
        {"/extensions/KHR_materials_transmission/transmissionFactor", 0.5},
        {"/pbrMetallicRoughness/metallicFactor", 0.5},
        {"/extensions/KHR_materials_transmission/transmissionTexture", {{"index", 0}}}};
    for (const double ior : {1.0, 1.5})
        for (const auto& [path, value] : cases) {
            SCOPED_TRACE(path);
            Json material = boundary();
            material["extensions"]["KHR_materials_ior"]["ior"] = ior;
            material["pbrMetallicRoughness"]["metallicRoughnessTexture"] = {{"index", 0}};
            material[Json::json_pointer(path)] = value;
            material["extras"] = {{"wavepath_medium", {{"sigma_a", {1, 2, 3}}}}};
            const Scene scene = load(with_image(material));
            EXPECT_NE(scene.materials[0].boundary, Boundary::opaque);
            EXPECT_TRUE(scene.materials[0].transmits_in_part());
            EXPECT_TRUE(scene.materials[0].has(TEXTURE_METALLIC_ROUGHNESS));
            EXPECT_THAT(scene.materials[0].medium.sigma_a, ElementsAre(1, 2, 3));
            EXPECT_THAT(scene.ignored, IsEmpty());
        }
}

// Metal is, but for a texture that may make it none in places.
TEST(GltfMedium, OfMetalEnclosesNothing) {
    Json material = boundary();
    material["pbrMetallicRoughness"]["metallicFactor"] = 1;
    const Scene metal = load(with_image(material));
    EXPECT_EQ(metal.materials[0].boundary, Boundary::opaque);
    EXPECT_EQ(metal.materials[0].transmission, 0);
    EXPECT_THAT(metal.ignored, IsEmpty());
    material["pbrMetallicRoughness"]["metallicRoughnessTexture"] = {{"index", 0}};
    const Scene textured = load(with_image(material));
    EXPECT_EQ(textured.materials[0].boundary, Boundary::index_matched);
    EXPECT_TRUE(textured.materials[0].transmits_in_part());
    EXPECT_THAT(textured.ignored, IsEmpty());
}

TEST(GltfMedium, ReadsDielectricsOfAnyRoughness) {
    for (const float roughness : {0.0F, 0.5F}) {
        Json material = boundary();
        material["extensions"]["KHR_materials_ior"]["ior"] = 1.33;
        material["pbrMetallicRoughness"]["roughnessFactor"] = roughness;
        const Scene scene = load(file_with(material));
        EXPECT_EQ(scene.materials[0].boundary, Boundary::dielectric);
        EXPECT_EQ(scene.materials[0].ior, 1.33F);
        EXPECT_EQ(scene.materials[0].roughness, roughness);
        EXPECT_THAT(scene.ignored, IsEmpty());
    }
}

TEST(GltfMedium, ReadsRoughnessTexturesOfWhatRefracts) {
    Json material = boundary();
    material["pbrMetallicRoughness"]["metallicRoughnessTexture"] = {{"index", 0}};
    const Scene matched = load(with_image(material));  // without microfacets
    EXPECT_FALSE(matched.materials[0].has(TEXTURE_METALLIC_ROUGHNESS));
    EXPECT_THAT(matched.ignored, IsEmpty());
    material["extensions"]["KHR_materials_ior"]["ior"] = 1.5;
    const Scene glass = load(with_image(material));
    EXPECT_TRUE(glass.materials[0].has(TEXTURE_METALLIC_ROUGHNESS));
    EXPECT_FALSE(glass.materials[0].transmits_in_part());
    EXPECT_THAT(glass.ignored, IsEmpty());
}

TEST(GltfMedium, IsBoundedWithoutAlpha) {
    for (const char* mode : {"MASK", "BLEND"}) {
        Json material = boundary();
        material["alphaMode"] = mode;
        const Scene scene = load(file_with(material));
        EXPECT_EQ(scene.materials[0].alpha_mode, AlphaMode::opaque);
        EXPECT_THAT(scene.ignored, ElementsAre(HasSubstr("alpha modes of volumes (1)")));
    }
}

}  // namespace
}  // namespace wavepath
