// Tests src/gltf/gltf_schema.cpp and the table of members.
#include "gltf/gltf_schema.h"

#include "gltf/gltf_members.h"
#include "support/case_files.h"
#include "support/gltf_builder.h"

#include <gmock/gmock.h>

#include <set>

namespace wavepath {
namespace {

using Json = GltfBuilder::Json;
using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

// A triangle with something of most that is read, whole.
GltfBuilder everything() {
    GltfBuilder gltf;
    gltf.root["materials"] = {
        {{"name", "red"},
         {"pbrMetallicRoughness",
          {{"baseColorFactor", {1, 0, 0, 1}},
           {"metallicFactor", 0},
           {"baseColorTexture",
            {{"index", 0},
             {"texCoord", 0},
             {"extensions", {{"KHR_texture_transform", {{"texCoord", 0}, {"rotation", 1}}}}}}}}},
         {"alphaCutoff", 0.5},
         {"doubleSided", true},
         {"extensions", {{"KHR_materials_ior", {{"ior", 1.5}}}}}}};
    gltf.root["textures"] = {{{"source", 0}, {"sampler", 0}}};
    gltf.root["samplers"] = {{{"wrapS", 33071}, {"magFilter", 9728}}};
    gltf.root["images"] = {
        {{"uri",
          "data:image/png;base64,"
          "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAA"
          "AACklEQVR4nGP4DwABAQEAsTj2FAAAAABJRU5ErkJggg=="}}};
    gltf.root["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
    gltf.root["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "spot"}, {"intensity", 3}, {"spot", {{"outerConeAngle", 1}}}}};
    gltf.object(
        {{"attributes",
          {{"POSITION", gltf.triangle_positions()},
           {"TEXCOORD_0", gltf.accessor<float>("VEC2", {0, 0, 1, 0, 0, 1})}}},
         {"indices", gltf.accessor<std::uint8_t>("SCALAR", {0, 1, 2})},
         {"mode", 4},
         {"material", 0}});
    gltf.node({{"camera", 0}, {"children", Json::array()}});
    gltf.node({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    return gltf;
}

// Every integer of the tree as a 1.0.
void write_as_floats(Json& value) {
    if (value.is_structured())
        for (Json& child : value) write_as_floats(child);
    else if (value.is_number_integer())
        value = value.get<double>();
}

TEST(GltfSchema, TakesIntegersWrittenAsFloats) {
    GltfBuilder gltf = everything();
    gltf.root["buffers"] = Json::parse(gltf.text())["buffers"];
    const Scene whole = load(gltf);
    ASSERT_EQ(whole.images.size(), 1U);
    for (auto& [key, element] : gltf.root.items())
        if (key != "asset") write_as_floats(element);
    const Scene scene = load(gltf);
    EXPECT_EQ(scene.primitives.at(0).positions, whole.primitives.at(0).positions);
    EXPECT_EQ(scene.primitives.at(0).indices, whole.primitives.at(0).indices);
    EXPECT_EQ(scene.primitives.at(0).material, 0U);
    EXPECT_TRUE(scene.materials.at(0).texture(TEXTURE_BASE_COLOR).nearest);
    EXPECT_EQ(scene.images.size(), 1U);
    EXPECT_EQ(scene.cameras.size(), 1U);
    EXPECT_EQ(scene.lights.size(), 1U);
    EXPECT_EQ(scene.ignored, whole.ignored);
}

TEST(GltfSchema, TakesExponents) {
    const TemporaryFolder folder;
    GltfBuilder gltf;
    gltf.triangle();
    std::string text = gltf.text();
    text.replace(text.find("\"count\":3"), 9, "\"count\":0.3e1");
    EXPECT_EQ(load_gltf(folder.write("scene.gltf", text)).triangle_count(), 1U);
}

struct Wrong {
    const char* path;
    Json value;
    const char* line;
};

TEST(GltfSchema, NamesMembersOfTheWrongType) {
    const Wrong cases[] = {
        {"/materials/0/doubleSided", 1, "material 0 \"red\": doubleSided is 1, not true or false"},
        {"/materials/0/name", 7, "material 0: name is 7, not a text"},
        {"/materials/0/alphaCutoff", "half",
         "material 0 \"red\": alphaCutoff is \"half\", not a number"},
        {"/materials/0/pbrMetallicRoughness", Json::array(),
         "material 0 \"red\": pbrMetallicRoughness is an array, not an object"},
        {"/materials/0/pbrMetallicRoughness/metallicFactor", "0",
         "material 0 \"red\": pbrMetallicRoughness.metallicFactor is \"0\", not a number"},
        {"/materials/0/pbrMetallicRoughness/baseColorFactor/1", nullptr,
         "pbrMetallicRoughness.baseColorFactor[1] is null, not a number"},
        {"/materials/0/pbrMetallicRoughness/baseColorTexture/index", 0.5,
         "pbrMetallicRoughness.baseColorTexture.index is 0.5, not an integer from 0 to 2^31"},
        {"/materials/0/pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform/"
         "rotation",
         "1", "baseColorTexture.extensions.KHR_texture_transform.rotation is \"1\", not a number"},
        {"/materials/0/extensions/KHR_materials_ior/ior", true,
         "extensions.KHR_materials_ior.ior is true, not a number"},
        {"/meshes/0/primitives/0/material", 0.5,
         "mesh 0: primitives[0].material is 0.5, not an integer from 0 to 2^31"},
        {"/meshes/0/primitives/0/indices", "1", "mesh 0: primitives[0].indices is \"1\", not an"},
        {"/meshes/0/primitives/0/attributes/POSITION", 1e-9,
         "mesh 0: primitives[0].attributes.POSITION is 1e-09, not an integer"},
        {"/meshes/0/primitives", Json::object(), "mesh 0: primitives is an object, not an array"},
        {"/meshes/0/primitives/0/material", 4294967296, "is 4294967296, not an integer"},
        {"/nodes/0/mesh", 1.5, "node 0: mesh is 1.5, not an integer"},
        {"/nodes/0/mesh", -1, "node 0: mesh is -1, not an integer"},
        {"/meshes/0/primitives/0/material", -1.0,
         "mesh 0: primitives[0].material is -1, not an integer"},
        {"/accessors/0/bufferView", -1, "accessor 0: bufferView is -1, not an integer"},
        {"/nodes/1/children", 3, "node 1: children is 3, not an array"},
        {"/nodes/1", nullptr, "node 1 is null, not an object"},
        {"/scenes/0/nodes/1", "1", "scene 0: nodes[1] is \"1\", not an integer"},
        {"/scene", 0.25, "scene is 0.25, not an integer"},
        {"/nodes", 3, "nodes is 3, not an array"},
        {"/accessors/0/count", 2.5, "accessor 0: count is 2.5, not an integer from 0 on"},
        {"/accessors/0/byteOffset", -4, "accessor 0: byteOffset is -4, not an integer from 0"},
        {"/accessors/0/normalized", "no", "accessor 0: normalized is \"no\", not true or false"},
        {"/bufferViews/0/byteStride", "12", "bufferView 0: byteStride is \"12\", not an integer"},
        {"/samplers/0/wrapS", 1.5, "sampler 0: wrapS is 1.5, not an integer"},
        {"/textures/0/source", "0", "texture 0: source is \"0\", not an integer"},
        {"/images/0/uri", 4, "image 0: uri is 4, not a text"},
        {"/cameras/0/perspective/aspectRatio", "16:9",
         "camera 0: perspective.aspectRatio is \"16:9\", not a number"},
        {"/extensions/KHR_lights_punctual/lights/0/intensity", "3",
         "light 0: intensity is \"3\", not a number"},
        {"/extensions/KHR_lights_punctual/lights/0/spot/outerConeAngle", nullptr,
         "light 0: spot.outerConeAngle is null, not a number"},
        {"/nodes/2/extensions/KHR_lights_punctual/light", 0.5,
         "node 2: extensions.KHR_lights_punctual.light is 0.5, not an integer"},
        {"/asset/version", 2, "asset.version is 2, not a text"},
    };
    for (const auto& [path, value, line] : cases) {
        GltfBuilder gltf = everything();
        gltf.root[Json::json_pointer(path)] = value;
        EXPECT_THAT(
            load_error(gltf), AllOf(
                                  StartsWith("scene.gltf: "), HasSubstr(line),
                                  EndsWith("; repair the file or export again")))
            << path;
    }
}

TEST(GltfSchema, NamesWhatIsMissing) {
    GltfBuilder gltf = everything();
    gltf.root["cameras"][0]["perspective"].erase("yfov");
    EXPECT_THAT(load_error(gltf), HasSubstr("camera 0: perspective.yfov is missing"));
    gltf = everything();
    gltf.root["extensions"]["KHR_lights_punctual"]["lights"][0].erase("type");
    EXPECT_THAT(load_error(gltf), HasSubstr("light 0: type is missing"));
    gltf = everything();
    gltf.root["meshes"][0]["primitives"][0].erase("attributes");
    EXPECT_THAT(load_error(gltf), HasSubstr("mesh 0: primitives[0].attributes is missing"));
}

TEST(GltfSchema, LeavesAloneWhatNothingReads) {
    GltfBuilder gltf = everything();
    gltf.root["extras"] = nullptr;
    gltf.root["nodes"][0]["extras"] = {{"matrix", "none"}};
    gltf.root["materials"][0]["extensions"]["OTHERS_paint"] = 5;
    gltf.root["accessors"][0]["min"] = "unknown";
    gltf.root["asset"]["generator"] = 12;
    gltf.root["animations"] = {{{"channels", 3}}};
    gltf.root["future"] = {{"count", "many"}};
    EXPECT_EQ(load_error(gltf), "");
}

// A kind without rules would be judged by nothing.
TEST(GltfSchema, KnowsEveryKindItNames) {
    std::set<std::string_view> kinds{"boolean", "number", "text",     "index",
                                     "size",    "unlit",  "animation"};
    for (const Member& member : members_read()) kinds.insert(member.of);
    for (const Member& member : members_read()) {
        const std::string_view kind = member.type.substr(0, member.type.find_first_of("[!?"));
        EXPECT_TRUE(kinds.contains(kind)) << member.of << ": " << member.name << " " << kind;
    }
}

TEST(GltfSchema, ReadsTheFilesOfOthers) {
    const auto folder = case_folder("floats-for-integers");
    if (folder.empty()) GTEST_SKIP() << "no folder of cases beside the checkout";
    const Scene whole = load_gltf(folder / "integers.gltf");
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() != ".gltf") continue;
        const Scene scene = load_gltf(entry.path());
        EXPECT_EQ(scene.triangle_count(), whole.triangle_count()) << entry.path();
        ASSERT_EQ(scene.primitives.size(), whole.primitives.size()) << entry.path();
        for (std::size_t i = 0; i < scene.primitives.size(); ++i) {
            EXPECT_EQ(scene.primitives[i].positions, whole.primitives[i].positions);
            EXPECT_EQ(scene.primitives[i].material, whole.primitives[i].material);
        }
        EXPECT_EQ(scene.ignored, whole.ignored) << entry.path();
    }
}

}  // namespace
}  // namespace wavepath
