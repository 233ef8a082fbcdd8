// `wavepath profile --against`: the same bits by other kernels.
#include "support/command.h"

#include <gmock/gmock.h>

#include <fstream>

namespace wavepath {
namespace {

using testing::HasSubstr;

class Against : public CommandTest {
  protected:
    // Renders a scene against both baselines that promise the same bits, and expects them.
    void expect_same_bits(const std::string& scene) const {
        SCOPED_TRACE(scene);
        const Outcome outcome =
            run("profile " + scene +
                " --size 32x32 --spp 4 --against megakernel --against full-features --json " +
                path("a.json"));
        ASSERT_EQ(outcome.exit_code, 0) << outcome.words;
        const nlohmann::json rows = json("a.json")["baselines"];
        ASSERT_EQ(rows.size(), 2U);
        EXPECT_EQ(rows[0]["against"], "megakernel");
        EXPECT_EQ(rows[1]["against"], "full-features");
        for (const nlohmann::json& row : rows) {
            EXPECT_EQ(row["differing_pixels"], 0) << row["against"];
            EXPECT_GT(row["seconds"], 0);
            EXPECT_LE(row["least_ratio"], row["ratio"]);
            EXPECT_LE(row["ratio"], row["greatest_ratio"]);
        }
    }
};

TEST_F(Against, PicturesOfSurfacesKeepTheirBits) {
    expect_same_bits(cornell_box);
}

TEST_F(Against, PicturesOfFogKeepTheirBits) {
    expect_same_bits(WAVEPATH_SOURCE_DIR "/scenes/fog_shaft/scene.gltf");
}

TEST_F(Against, PicturesOfGlassKeepTheirBits) {
    expect_same_bits(WAVEPATH_SOURCE_DIR "/scenes/glass_of_liquid/scene.gltf");
}

// Of diffuse materials alone, for kernels of textured lobes take a minute to compile.
TEST_F(Against, PicturesOfTexturesKeepTheirBits) {
    std::ifstream file(WAVEPATH_SOURCE_DIR "/tests/oclgrind/textures.gltf");
    nlohmann::json scene = nlohmann::json::parse(file);
    for (nlohmann::json& material : scene["materials"]) {
        material.erase("normalTexture");
        material["pbrMetallicRoughness"].erase("metallicRoughnessTexture");
        material["pbrMetallicRoughness"]["metallicFactor"] = 0;
        if (material["name"] != "unlit")
            material["extensions"] = {{"KHR_materials_specular", {{"specularFactor", 0}}}};
    }
    folder.write("diffuse.gltf", scene.dump());
    expect_same_bits(path("diffuse.gltf") + " --env-radiance .5,.6,.7");
}

// Paths that branch take other stages, and stay in their slot.
TEST_F(Against, PicturesOfBranchingPathsKeepTheirBits) {
    expect_same_bits(
        WAVEPATH_SOURCE_DIR
        "/scenes/fog_shaft/scene.gltf --distance equiangular --splits 2,2,2 --split-depth 2");
}

TEST_F(Against, AnotherDeviceIsOpenedByItsName) {
    const Outcome outcome = run(
        "profile " + cornell_box + " --size 8x8 --spp 1 --against cpu --json " + path("a.json"));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.words;
    const nlohmann::json row = json("a.json")["baselines"][0];
    EXPECT_EQ(row["against"], "cpu");
    EXPECT_NE(row["device"], "");
    EXPECT_THAT(outcome.words, HasSubstr("\ncpu "));
}

TEST_F(Against, WhatCannotBeComparedIsRefusedBeforeARender) {
    const Outcome timed =
        run("profile " + cornell_box + " --time 1 --against megakernel --json " + path("a.json"));
    EXPECT_EQ(timed.exit_code, 1);
    EXPECT_THAT(timed.words, HasSubstr("use --spp, not --time or --target-error"));
    const Outcome unknown =
        run("profile " + cornell_box + " --against nowhere --json " + path("a.json"));
    EXPECT_EQ(unknown.exit_code, 1);
    EXPECT_THAT(unknown.words, HasSubstr("nowhere"));
    EXPECT_FALSE(std::filesystem::exists(path("a.json")));
}

}  // namespace
}  // namespace wavepath
