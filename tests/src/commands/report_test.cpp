#include "commands/report.h"
#include "build_paths.h"

#include <gtest/gtest.h>

namespace wavepath {
namespace {

TEST(SettingsReport, NamesAllThatMakesThePicture) {
    RenderOptions options;
    options.scene = WAVEPATH_SOURCE_DIR "/scenes/cornell_box/scene.gltf";
    options.look_at = "1,2,3,1,2,0";
    options.fov = 30;
    options.environment_radiance = "1,2,3";
    options.sampler = "independent";
    options.layering = "specification";
    options.splits = "1,1,2";
    options.split_depth = 3;
    options.termination = "roulette:0.5";
    options.scene_of_file = "0";
    options.pool = 300;
    const auto report = settings_report(prepare_job(options));
    EXPECT_EQ(report["camera"], "look-at");
    EXPECT_EQ(report["camera_to_world"][12], 1);
    EXPECT_EQ(report["camera_to_world"][13], 2);
    EXPECT_EQ(report["camera_to_world"][14], 3);
    EXPECT_NEAR(report["y_fov_deg"].get<double>(), 30, 1e-9);
    EXPECT_EQ(report["environment"]["map"], "");
    EXPECT_EQ(report["environment"]["radiance"], nlohmann::ordered_json({1.0F, 2.0F, 3.0F}));
    EXPECT_EQ(report["sampler"], "independent");
    EXPECT_EQ(report["layering"], "specification");
    EXPECT_EQ(report["splits"], nlohmann::ordered_json({1, 1, 2}));
    EXPECT_EQ(report["split_depth"], 3);
    EXPECT_EQ(report["termination"], "roulette:0.5");
    EXPECT_EQ(report["scene_of_file"], "0");
    EXPECT_EQ(report["pool"], 300);
    EXPECT_TRUE(report["orthographic_m"].is_null());
}

TEST(SettingsReport, NamesTheViewOfAnOrthographicCamera) {
    RenderJob job;
    job.settings.camera.orthographic = true;
    job.settings.camera.x_mag = 2;
    job.settings.camera.y_mag = 3;
    const auto report = settings_report(job);
    EXPECT_TRUE(report["y_fov_deg"].is_null());
    EXPECT_EQ(report["orthographic_m"], nlohmann::ordered_json({2.0, 3.0}));
}

TEST(SettingsReport, BiasNamesEveryReason) {
    RenderSettings settings;
    EXPECT_EQ(settings.bias(), "");
    settings.termination = parse_termination("depth:3");
    const std::string cut = settings.bias();
    EXPECT_NE(cut, "");
    settings.target_error = 0.1;
    EXPECT_NE(settings.bias().find("--target-error"), std::string::npos);
    EXPECT_NE(settings.bias().find(cut), std::string::npos);
}

}  // namespace
}  // namespace wavepath
