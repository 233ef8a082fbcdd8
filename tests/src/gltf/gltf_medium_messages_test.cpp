// What is said of media in glTF files that are not rendered as they stand, and what is refused.
#include "support/gltf_media.h"

#include <gmock/gmock.h>

namespace wavepath {
namespace {

using Json = GltfBuilder::Json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(GltfMedium, SaysThatUnlitMaterialsEncloseNothing) {
    Json material = boundary();
    material["extensions"]["KHR_materials_unlit"] = Json::object();
    const Scene scene = load(file_with(material));
    EXPECT_EQ(scene.materials[0].boundary, Boundary::opaque);
    EXPECT_THAT(scene.ignored, ElementsAre(HasSubstr("volumes of unlit materials (1)")));
}

TEST(GltfMedium, SaysWhatIsAThinWallInstead) {
    Json material = boundary();
    material["extensions"]["KHR_materials_ior"]["ior"] = 0;
    const Scene scene = load(file_with(material));
    EXPECT_EQ(scene.materials[0].boundary, Boundary::opaque);
    EXPECT_GT(scene.materials[0].transmission, 0);
    EXPECT_THAT(scene.ignored, ElementsAre(HasSubstr("refract with ior 0 (1)")));
}

TEST(GltfMedium, SaysThatItDoesNotReadTexturesOfWhatScatters) {
    Json material = boundary();
    material["extensions"]["KHR_materials_scatter"]["multiscatterColorTexture"] = {{"index", 0}};
    attenuate(material);
    const Scene scene = load(with_image(material));
    for (const Texture& texture : scene.materials[0].textures) EXPECT_FALSE(texture.image);
    EXPECT_THAT(scene.ignored, ElementsAre(HasSubstr("textures of what scatters in volumes (1)")));
}

TEST(GltfMedium, SaysWhichMembersItDoesNotKnow) {
    Json material = boundary();
    material["extensions"]["KHR_materials_scatter"] = {
        {"scatterStrength", 1}, {"multiscatterColorFactor", {1, 1, 1}}};
    attenuate(material);
    EXPECT_THAT(
        load(file_with(material)).ignored,
        ElementsAre(HasSubstr("members KHR_materials_scatter.scatterStrength")));
}

TEST(GltfMedium, SaysWhatWouldStayClear) {
    Json material = boundary();
    material["extras"] = {{"wavepath_media", {{"sigma_s", {1, 1, 1}}}}};
    EXPECT_THAT(load(file_with(material)).ignored, ElementsAre(HasSubstr("extras.wavepath_media")));
    material["extras"] = {{"Wavepath_medium", {{"sigma_s", {1, 1, 1}}}}};
    EXPECT_THAT(
        load(file_with(material)).ignored, ElementsAre(HasSubstr("extras.Wavepath_medium")));
    material = boundary();
    material["extensions"]["KHR_materials_scatter"] = {{"scatterStrengthFactor", 1}};
    EXPECT_THAT(
        load(file_with(material)).ignored,
        ElementsAre(HasSubstr("scattering of volumes without attenuationDistance")));
}

TEST(GltfMedium, SaysWhereItIsMisplaced) {
    const Json extras = {{"wavepath_medium", {{"sigma_s", {1, 1, 1}}}}};
    const auto expect_said = [](const GltfBuilder& gltf) {
        EXPECT_THAT(
            load(gltf).ignored,
            ElementsAre(HasSubstr("members wavepath_medium outside of extras of materials (1)")));
    };
    GltfBuilder gltf = file_with(boundary());
    gltf.root["nodes"][0]["extras"] = extras;
    expect_said(gltf);
    gltf = file_with(boundary());
    gltf.root["meshes"][0]["extras"] = extras;
    expect_said(gltf);
    gltf = file_with(boundary());
    gltf.root["meshes"][0]["primitives"][0]["extras"] = extras;
    expect_said(gltf);
    Json material = boundary();
    material["extensions"]["KHR_materials_volume"]["extras"] = extras;
    expect_said(file_with(material));
    material = boundary();
    material["extensions"]["KHR_materials_volume"].update(extras);
    expect_said(file_with(material));
}

TEST(GltfMedium, RefusesWhatMeansNothing) {
    const auto refusal = [](const Json& material) { return load_error(file_with(material)); };
    EXPECT_THAT(
        refusal(with_extras({{"sigma_a", {0, -1, 0}}})),
        HasSubstr("holds -1, not in 0 .. 3.4e+38; repair it"));
    EXPECT_THAT(
        refusal(with_extras({{"sigma_a", {0, 1e39, 0}}})), HasSubstr("holds 1e+39, not in"));
    EXPECT_THAT(
        refusal(with_extras({{"sigma_s", {1, 1}}})),
        HasSubstr("2 numbers instead of 3; repair it"));
    EXPECT_THAT(
        refusal(with_extras({{"sigma_s", "red"}})),
        HasSubstr("extras.wavepath_medium.sigma_s is \"red\", not an array"));
    EXPECT_THAT(refusal(with_extras({{"g", 1}})), HasSubstr("g is 1"));
    EXPECT_THAT(refusal(with_extras({{"sigma", {1, 1, 1}}})), HasSubstr("no member \"sigma\""));
    EXPECT_THAT(
        refusal(with_extras(1)),
        HasSubstr("material 0: extras.wavepath_medium is 1, not an object"));
    EXPECT_THAT(
        refusal(with_extras(nullptr)),
        HasSubstr("material 0: extras.wavepath_medium is null, not an object; repair"));
    EXPECT_THAT(
        refusal(with_extras({{"sigma_s", {1, nullptr, 1}}})),
        HasSubstr("extras.wavepath_medium.sigma_s[1] is null, not a number; repair"));
    Json material = with_extras({{"sigma_a", {1, 1, 1}}});
    material["extensions"].erase("KHR_materials_volume");
    EXPECT_THAT(refusal(material), HasSubstr("needs KHR_materials_volume with thicknessFactor"));
    struct Conflict {
        const char* path;
        Json value;
        const char* line;
    };
    const Conflict conflicts[] = {
        {"/extensions/KHR_materials_transmission/transmissionFactor", 0,
         "needs KHR_materials_transmission with transmissionFactor above 0;"},
        {"/extensions/KHR_materials_ior/ior", 0, "needs an ior of 1 or more;"},
        {"/extensions/KHR_materials_unlit", Json::object(), "needs no KHR_materials_unlit;"},
        {"/pbrMetallicRoughness/metallicFactor", 1,
         "needs metallicFactor below 1, or a metallicRoughnessTexture;"},
    };
    for (const auto& [path, value, line] : conflicts) {
        material = with_extras({{"sigma_a", {1, 1, 1}}});
        material[Json::json_pointer(path)] = value;
        EXPECT_THAT(refusal(material), HasSubstr(line)) << path;
    }
    material = boundary();
    material["extensions"]["KHR_materials_scatter"]["scatterAnisotropy"] = 1;
    EXPECT_THAT(refusal(material), HasSubstr("scatterAnisotropy is 1, not in -0.99999 .. 0.99999"));
    for (const Json& no_object : {Json(nullptr), Json::array({1}), Json(1)}) {
        material = boundary();
        material["extensions"]["KHR_materials_scatter"] = no_object;
        EXPECT_THAT(
            refusal(material),
            AllOf(HasSubstr("extensions.KHR_materials_scatter is"), HasSubstr("not an object;")));
    }
    material = boundary();
    material["extensions"] = 1;
    EXPECT_THAT(refusal(material), HasSubstr("material 0: extensions is 1, not an object; repair"));
    material = boundary();
    material["extensions"]["OTHERS_extension"] = {{"of another", nullptr}};
    material["extras"] = {{"of another", nullptr}};
    EXPECT_EQ(refusal(material), "");
    material["extras"] = nullptr;
    EXPECT_EQ(refusal(material), "");
    material = boundary();
    material["emissiveFactor"] = {1, 1, 1};
    EXPECT_THAT(refusal(material), HasSubstr("ior 1 and emits"));
    material = boundary();
    material["extensions"]["KHR_materials_volume"]["attenuationDistance"] = 0;
    EXPECT_THAT(refusal(material), HasSubstr("attenuationDistance is 0; it has to be above 0"));
    material["extensions"]["KHR_materials_volume"]["attenuationDistance"] = 1e-40;
    material["extensions"]["KHR_materials_volume"]["attenuationColor"] = {0.5, 0.5, 0.5};
    EXPECT_THAT(refusal(material), HasSubstr("attenuationDistance is 1e-40 m, too short"));
    material = boundary();
    material["extensions"]["KHR_materials_volume"]["thicknessFactor"] = -1;
    EXPECT_THAT(refusal(material), HasSubstr("thicknessFactor is -1; it has to be 0 or more"));
}

}  // namespace
}  // namespace wavepath
