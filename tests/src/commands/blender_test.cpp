// What files from Blender need: lumens, and an exposure that finds itself.
#include "gltf/gltf_loader.h"
#include "image/exr_writer.h"
#include "support/case_files.h"
#include "support/command.h"
#include "support/gltf_builder.h"
#include "support/rendering.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

namespace wavepath {
namespace {

using testing::HasSubstr;
using testing::Not;

class FromBlender : public CommandTest {
  protected:
    // A triangle below a sun of `intensity`, as `generator` would write it.
    std::string sunny(const std::string& name, double intensity, const std::string& generator) {
        GltfBuilder builder;
        builder.triangle();
        builder.root["asset"]["generator"] = generator;
        builder.root["extensionsUsed"] = {"KHR_lights_punctual"};
        builder.root["extensions"]["KHR_lights_punctual"]["lights"] = {
            {{"type", "directional"}, {"intensity", intensity}}};
        builder.node({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
        return folder.write(name, builder.text()).string();
    }

    Outcome look(const std::string& scene, const std::string& name, const std::string& more) {
        return run(
            "render " + scene + " --look-at 0.3,0.3,2,0.3,0.3,0 --size 8x8 --spp 4 " + more +
            " -o " + path(name + ".exr") + " " + path(name + ".png") + " --json " +
            path(name + ".json"));
    }
};

const std::string blender = "Khronos glTF Blender I/O v4.5.51";

TEST_F(FromBlender, LumensPerWattDivideTheLights) {
    const Outcome bright = look(sunny("lm.gltf", 683 * 4, blender), "a", "--lumens-per-watt 683");
    const Outcome plain = look(sunny("w.gltf", 4, blender), "b", "");
    EXPECT_EQ(bright.exit_code + plain.exit_code, 0) << bright.words << plain.words;
    const Image a = read_exr(path("a.exr"));
    EXPECT_EQ(a.channels, read_exr(path("b.exr")).channels);
    EXPECT_GT(*std::ranges::max_element(a.channels.at("R")), 0.1F);
    EXPECT_EQ(json("a.json")["settings"]["lumens_per_watt"], 683);
    EXPECT_EQ(json("b.json")["settings"]["lumens_per_watt"], 1);
}

TEST_F(FromBlender, HintsAtLumensOnlyWhereTheyAreLikely) {
    const std::string hint = "use --lumens-per-watt 683";
    const std::string bright = sunny("bright.gltf", 683, blender);
    EXPECT_THAT(look(bright, "a", "").words, HasSubstr(hint));
    EXPECT_THAT(look(bright, "a", "--lumens-per-watt 683").words, Not(HasSubstr(hint)));
    EXPECT_THAT(look(sunny("dim.gltf", 4, blender), "a", "").words, Not(HasSubstr(hint)));
    EXPECT_THAT(look(sunny("other.gltf", 683, "another"), "a", "").words, Not(HasSubstr(hint)));
}

TEST_F(FromBlender, RefusesWhatIsNoEfficacy) {
    const std::string scene = sunny("w.gltf", 4, blender);
    for (const char* value : {"0", "-683", "nan", "inf"}) {
        const Outcome outcome = look(scene, "a", std::string("--lumens-per-watt ") + value);
        EXPECT_EQ(outcome.exit_code, 1) << value;
        EXPECT_THAT(outcome.words, HasSubstr("use a number above 0"));
    }
    EXPECT_THAT(
        look(scene, "a", "--lumens-per-watt 1e-300").words, HasSubstr("brighter than floats"));
}

// The picture is the one of the exposure that is said.
TEST_F(FromBlender, AutomaticExposureIsSaidAndRepeatable) {
    const std::string scene = sunny("w.gltf", 4, blender);
    const Outcome automatic = look(scene, "a", "--exposure auto");
    const double stops = json("a.json")["exposure_ev"];
    EXPECT_NE(stops, 0);
    const std::string text = fmt::format("{}", stops);
    EXPECT_THAT(automatic.words, HasSubstr("--exposure auto is " + text + " EV"));
    look(scene, "b", "--exposure " + text);
    EXPECT_EQ(folder.read("a.png"), folder.read("b.png"));
    EXPECT_EQ(json("b.json")["exposure_ev"], stops);
    look(scene, "c", "--exposure +1.5");
    EXPECT_EQ(json("c.json")["exposure_ev"], 1.5);
    look(scene, "c", "--exposure -1.5");
    EXPECT_EQ(json("c.json")["exposure_ev"], -1.5);
    EXPECT_THAT(look(scene, "c", "--exposure atuo").words, HasSubstr("--exposure atuo: use stops"));
}

// The default export of Blender 5: white without a word before, now a hint; grey with both options.
TEST_F(FromBlender, DefaultExportIsNoWhitePicture) {
    const auto file = asset_folder().parent_path() / "cases/blender/blender_default_light_mode.glb";
    if (!std::filesystem::exists(file)) GTEST_SKIP() << "no sample files beside the checkout";
    const std::string render = "render " + file.string() + " --size 32x18 --spp 4 -o " +
                               path("a.png") + " --json " + path("a.json");
    EXPECT_THAT(run(render).words, HasSubstr("--lumens-per-watt 683"));
    const Outcome outcome = run(render + " --lumens-per-watt 683 --exposure auto");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.words;
    EXPECT_LT(std::abs(json("a.json")["exposure_ev"].get<double>()), 4);
}

// What Blender calls a sun of strength 2 and a point light of 200 W is 683 times as much without
// the option, in every pixel: the random numbers are the same. Then a point of the floor, made
// white.
TEST(BlenderFile, IsAsBrightAsInBlenderOnceLumensAreDivided) {
    const auto folder = case_folder("blender");
    if (folder.empty()) GTEST_SKIP() << "no folder of cases beside the checkout";
    const auto load = [&](double lumens_per_watt) {
        return load_gltf(
            folder / "blender_default_light_mode.glb", "", default_most_texels, lumens_per_watt);
    };
    const auto pixels = [&](double lumens_per_watt) {
        const Scene scene = load(lumens_per_watt);
        RenderSettings settings = square_settings("mis", scene.cameras.at(0), 16, 4);
        return render_scene(scene, settings).film.image.channels.at("R");
    };
    const std::vector<float> bright = pixels(1);
    const std::vector<float> right = pixels(683);
    for (std::size_t i = 0; i < right.size(); ++i)
        EXPECT_NEAR(bright[i], 683 * right[i], 1e-4 * bright[i]) << i;

    Scene scene = load(683);
    ASSERT_EQ(scene.lights.size(), 2U);
    EXPECT_NEAR(scene.lights[0].intensity[0], 2, 1e-5);
    EXPECT_NEAR(scene.lights[1].intensity[0], 200 / (4 * std::numbers::pi), 1e-4);
    scene.materials.at(scene.primitives.at(scene.instances.at(0).primitive).material) =
        lambert(grey(1));
    const Vec3d at{2.5, 0, 1.5};
    RenderSettings settings = square_settings("mis", close_up(at, {0, 1, 0}, 0.1, 1e-3), 16, 64);
    settings.termination = parse_termination("depth:1");
    const Vec3d& lamp = scene.lights[1].position;
    const double square =
        std::pow(lamp[0] - at[0], 2) + std::pow(lamp[1], 2) + std::pow(lamp[2] - at[2], 2);
    const double irradiance = -2 * scene.lights[0].direction[1] +
                              200 / (4 * std::numbers::pi) * lamp[1] / std::pow(square, 1.5);
    EXPECT_TRUE(has_mean(
        shared_mean(render_for({}, scene, settings)), irradiance / std::numbers::pi,
        {.truth_error = 1e-5}));
}

}  // namespace
}  // namespace wavepath
