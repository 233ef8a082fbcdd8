#include "gltf/gltf_material.h"

#include "support/gltf_builder.h"

#include <gmock/gmock.h>

namespace wavepath {
namespace {

using Json = GltfBuilder::Json;
using testing::HasSubstr;

Scene with_material(const Json& material) {
    GltfBuilder gltf;
    gltf.add("materials", material);
    gltf.object({{"attributes", {{"POSITION", gltf.triangle_positions()}}}, {"material", 0}});
    return load(gltf);
}

TEST(GltfMaterial, ReadsAllFactors) {
    const Scene scene = with_material(
        {{"name", "lamp"},
         {"pbrMetallicRoughness",
          {{"baseColorFactor", {0.25, 0.5, 0.75, 0.1}},
           {"metallicFactor", 0.5},
           {"roughnessFactor", 0.125}}},
         {"emissiveFactor", {1, 0.5, 0}},
         {"doubleSided", true},
         {"extensions",
          {{"KHR_materials_emissive_strength", {{"emissiveStrength", 8}}},
           {"KHR_materials_ior", {{"ior", 1.25}}},
           {"KHR_materials_specular",
            {{"specularFactor", 0.5}, {"specularColorFactor", {1, 2, 0.5}}}}}}});
    ASSERT_EQ(scene.materials.size(), 1U) << "the default material is not needed";
    const Material& material = scene.materials[0];
    EXPECT_EQ(material.name, "lamp");
    EXPECT_EQ(material.base_color, (Rgb{0.25F, 0.5F, 0.75F}));
    EXPECT_EQ(material.metallic, 0.5F);
    EXPECT_EQ(material.roughness, 0.125F);
    EXPECT_EQ(material.emission, (Rgb{8, 4, 0}));
    EXPECT_TRUE(material.double_sided);
    EXPECT_EQ(material.ior, 1.25F);
    EXPECT_EQ(material.specular, 0.5F);
    EXPECT_EQ(material.specular_color, (Rgb{1, 2, 0.5F}));
}

TEST(GltfMaterial, HasDefaults) {
    const Material material = with_material({{"extensions",
                                              {{"KHR_materials_emissive_strength", Json::object()},
                                               {"KHR_materials_ior", Json::object()},
                                               {"KHR_materials_specular", Json::object()}}}})
                                  .materials.at(0);
    EXPECT_EQ(material.base_color, (Rgb{1, 1, 1}));
    EXPECT_EQ(material.metallic, 1);
    EXPECT_EQ(material.roughness, 1);
    EXPECT_FALSE(material.emits());
    EXPECT_FALSE(material.double_sided);
    EXPECT_EQ(material.ior, 1.5F);
    EXPECT_EQ(material.specular, 1);
    EXPECT_EQ(material.specular_color, (Rgb{1, 1, 1}));
}

TEST(GltfMaterial, IsTheDefaultWhereAPrimitiveNamesNone) {
    GltfBuilder gltf;
    gltf.add("materials", {{"name", "unused"}});
    gltf.triangle();
    const Scene scene = load(gltf);
    ASSERT_EQ(scene.materials.size(), 2U);
    const std::uint32_t index = scene.primitives.at(0).material;
    EXPECT_EQ(index, 1U);
    EXPECT_EQ(scene.materials[index].name, "default");
    EXPECT_EQ(scene.materials[index].metallic, 1);
    EXPECT_EQ(scene.materials[index].roughness, 1);
}

TEST(GltfMaterial, TakesTheLegacyIorOfZero) {
    EXPECT_EQ(
        with_material({{"extensions", {{"KHR_materials_ior", {{"ior", 0}}}}}}).materials.at(0).ior,
        0);
}

TEST(GltfMaterial, TakesEmissionAboveOne) {
    EXPECT_EQ(
        with_material({{"emissiveFactor", {17, 12, 4}}}).materials.at(0).emission,
        (Rgb{17, 12, 4}));
}

TEST(GltfMaterial, ForgivesRoundingAndNoMore) {
    const auto roughness = [](double value) {
        return with_material({{"pbrMetallicRoughness", {{"roughnessFactor", value}}}})
            .materials.at(0)
            .roughness;
    };
    EXPECT_EQ(roughness(1.0000001192092896), 1.0F);
    EXPECT_EQ(roughness(-1e-8), 0.0F);
    EXPECT_EQ(
        error_of([&] { roughness(1.001); }),
        "scene.gltf: material 0: roughnessFactor is 1.001, not in 0 .. 1; repair the material");
}

TEST(GltfMaterial, RejectsFactorsOutOfRange) {
    const auto error = [](const Json& material) {
        return error_of([&] { with_material(material); });
    };
    const auto extension = [](const char* name, const Json& properties) {
        return Json{{"name", "glass"}, {"extensions", {{name, properties}}}};
    };
    EXPECT_THAT(
        error({{"pbrMetallicRoughness", {{"metallicFactor", -1}}}}),
        HasSubstr("metallicFactor is -1, not in 0 .. 1"));
    EXPECT_THAT(
        error({{"pbrMetallicRoughness", {{"baseColorFactor", {0, 2, 0, 1}}}}}),
        HasSubstr("baseColorFactor is 2, not in 0 .. 1"));
    EXPECT_THAT(
        error({{"pbrMetallicRoughness", {{"baseColorFactor", {0, 0, 0}}}}}),
        HasSubstr("must be 4, but got 3"));
    EXPECT_THAT(error({{"emissiveFactor", {0, -1, 0}}}), HasSubstr("is -1, not in 0 .. "));
    EXPECT_THAT(
        error({{"normalTexture", {{"index", 0}, {"scale", 1e20}}}}),
        HasSubstr("normalTexture.scale is 1e+20, not in -1e+06 .. 1e+06"));
    EXPECT_THAT(error({{"emissiveFactor", {0, 1}}}), HasSubstr("must be 3, but got 2"));
    EXPECT_EQ(
        error(extension("KHR_materials_ior", {{"ior", 0.9}})),
        "scene.gltf: material 0 \"glass\": ior is 0.9, not in 1 .. 3.40282e+38; repair the "
        "material");
    EXPECT_THAT(
        error(extension("KHR_materials_ior", {{"ior", "high"}})),
        HasSubstr("ior is \"high\", not a number"));
    EXPECT_THAT(
        error(extension("KHR_materials_specular", {{"specularFactor", 1.5}})),
        HasSubstr("specularFactor is 1.5, not in 0 .. 1"));
    EXPECT_THAT(
        error(extension("KHR_materials_specular", {{"specularColorFactor", {1, 1}}})),
        HasSubstr("specularColorFactor has 2 numbers instead of 3"));
    EXPECT_THAT(
        error(extension("KHR_materials_specular", {{"specularColorFactor", {1, "a", 1}}})),
        HasSubstr("specularColorFactor[1] is \"a\", not a number"));
    EXPECT_THAT(
        error(extension("KHR_materials_specular", {{"specularColorFactor", {1, -1, 1}}})),
        HasSubstr("specularColorFactor is -1, not in 0 .. "));
}

}  // namespace
}  // namespace wavepath
