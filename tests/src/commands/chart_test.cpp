// `wavepath chart`: what it measures, keeps and says.
#include "image/exr_writer.h"
#include "support/command.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <set>

namespace wavepath {
namespace {

using testing::HasSubstr;

class ChartCommand : public CommandTest {
  protected:
    // A small chart of the Cornell box into the test's folder.
    Outcome chart(const std::string& more) const {
        return run(
            "chart " + cornell_box + " --size 32x32 --spp 16 --seeds 2 --reference-spp 256 -o " +
            path("c") + " " + more);
    }

    void SetUp() override {
        if (std::system("gnuplot --version >/dev/null 2>&1") != 0)
            GTEST_SKIP() << "gnuplot is not installed";
    }
};

// The page, the CSV and the JSON hold the same numbers, which fall as they have to.
TEST_F(ChartCommand, MeasuresErrorAgainstTimeAndSamples) {
    const Outcome outcome =
        chart("--methods 'mis,path --sampler independent,path --termination depth:1'");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.words;
    const nlohmann::json report = json("c/chart.json");
    EXPECT_EQ(report["schema"], 1);
    EXPECT_EQ(report["seeds"], 2);
    const std::string page = folder.read("c/chart.html");
    std::map<std::string, nlohmann::json> variants;
    for (const nlohmann::json& variant : report["variants"]) {
        variants[variant["label"]] = variant;
        EXPECT_THAT(page, HasSubstr(variant["label"].get<std::string>()));
        ASSERT_EQ(variant["points"].size(), 2U);
        EXPECT_EQ(variant["points"][0]["samples"], 4);
        EXPECT_EQ(variant["points"][1]["samples"], 16);
        for (const nlohmann::json& point : variant["points"]) {
            ASSERT_EQ(point["rel_mse"].size(), 2U);
            for (const double seconds : point["seconds"]) EXPECT_GT(seconds, 0);
        }
    }
    const auto error = [&](const char* label, int point) {
        return variants.at(label)["points"][point]["rel_mse"][0].get<double>();
    };
    // 4 times the samples: a fourth of the error, within 20 % for 3072 numbers of a heavy law.
    EXPECT_NEAR(
        error("path --sampler independent", 1) / error("path --sampler independent", 0), 0.25,
        0.05);
    EXPECT_LT(error("mis", 1), 0.05 * error("path --sampler independent", 1));
    EXPECT_EQ(variants.at("mis")["verdict"], "sound");
    EXPECT_EQ(variants.at("mis")["bias"], "");
    const nlohmann::json& cut = variants.at("path --termination depth:1");
    EXPECT_EQ(cut["verdict"], "biased");
    EXPECT_THAT(cut["bias"].get<std::string>(), HasSubstr("more than 1 scattering"));
    // All indirect light is missing: its square is the floor, which more samples do not lower.
    EXPECT_GT(cut["floor_rel_mse"]["low"].get<double>(), 0.01);
    EXPECT_THAT(page, HasSubstr("bias of path --termination depth:1"));
    const std::string command = variants.at("path --sampler independent")["command"];
    for (const char* word : {"--method path", "--sampler independent", "--spp 16", "--seed 2"})
        EXPECT_THAT(command, HasSubstr(word));
    for (const char* link : {"src=\"http", "href=\"http", "url("})
        EXPECT_EQ(page.find(link), std::string::npos) << link;  // no network
    const std::string csv = folder.read("c/chart.csv");
    EXPECT_EQ(std::ranges::count(csv, '\n'), 1 + 3 * 2 * 2);
}

// A second run renders nothing, gives the same numbers, and only what is new is added.
TEST_F(ChartCommand, GoesOnWhereItWas) {
    ASSERT_EQ(chart("--methods mis").exit_code, 0);
    const nlohmann::json before = json("c/chart.json");
    const Outcome again = chart("--methods mis");
    ASSERT_EQ(again.exit_code, 0) << again.words;
    EXPECT_THAT(again.words, HasSubstr("0 pictures rendered"));
    EXPECT_EQ(json("c/chart.json"), before);
    const Outcome more = chart("--methods mis,bsdf");
    EXPECT_THAT(more.words, HasSubstr("4 pictures rendered"));
    EXPECT_EQ(json("c/chart.json")["variants"][0], before["variants"][0]);
    // One that is damaged is said, and rendered again.
    for (const auto& file : std::filesystem::directory_iterator(folder / "c" / "renders"))
        if (file.path().filename().string().starts_with("mis.16.1."))
            std::filesystem::resize_file(file.path(), 100);
    const Outcome mended = chart("--methods mis,bsdf");
    EXPECT_EQ(mended.exit_code, 0);
    EXPECT_THAT(mended.words, HasSubstr("it is rendered again"));
    EXPECT_THAT(mended.words, HasSubstr("1 pictures rendered"));
}

TEST_F(ChartCommand, SaysWhatItCannotTake) {
    EXPECT_THAT(chart("--methods mis,mis").words, HasSubstr("\"mis\" stands there twice"));
    EXPECT_THAT(chart("--methods 'mis --size 8x8'").words, HasSubstr("\"mis --size 8x8\""));
    EXPECT_THAT(chart("--methods ''").words, HasSubstr("name a method"));
    EXPECT_THAT(
        chart("--methods 'mis --termination never'").words,
        HasSubstr("\"mis --termination never\""));
    EXPECT_THAT(chart("--budget 2").words, HasSubstr("give one of them"));
    EXPECT_THAT(chart("--time 2").words, HasSubstr("give --budget"));
    EXPECT_THAT(chart("--seed 2").words, HasSubstr("--seed: a chart takes --methods"));
    EXPECT_THAT(chart("--reference nowhere.exr").words, HasSubstr("nowhere.exr"));
    for (const char* bad : {"--methods mis,mis", "--budget 2", "--reference nowhere.exr"})
        EXPECT_EQ(chart(bad).exit_code, 1) << bad;
    EXPECT_FALSE(std::filesystem::exists(folder / "c" / "chart.html"));
}

// A page's command renders the picture beside it.
TEST_F(ChartCommand, CommandsRenderTheirPictures) {
    ASSERT_EQ(chart("--methods 'path --termination depth:3'").exit_code, 0);
    const std::string command = json("c/chart.json")["variants"][0]["command"];
    ASSERT_TRUE(command.starts_with("wavepath ")) << command;
    ASSERT_EQ(run(command.substr(9) + " --quiet -o " + path("again.exr")).exit_code, 0);
    for (const auto& file : std::filesystem::directory_iterator(folder / "c" / "renders")) {
        if (!file.path().filename().string().starts_with("path___termination_depth_3.16.2."))
            continue;
        const Image kept = read_exr(file.path());
        const Image again = read_exr(path("again.exr"));
        for (const char* channel : {"R", "G", "B"})
            EXPECT_EQ(kept.channels.at(channel), again.channels.at(channel));
        return;
    }
    FAIL() << "no picture of 16 samples and seed 2 was kept";
}

// Its own error is not known then, and one of another size is refused before anything is rendered.
TEST_F(ChartCommand, TakesAReference) {
    const std::string picture = " --size 32x32 --spp 256 --seed 9 --quiet -o " + path("r.exr");
    ASSERT_EQ(run("render " + cornell_box + picture).exit_code, 0);
    const Outcome outcome = chart("--methods path --reference " + path("r.exr"));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.words;
    const nlohmann::json report = json("c/chart.json");
    EXPECT_TRUE(report["reference"]["rel_mse"].is_null());
    EXPECT_GT(report["variants"][0]["points"][1]["rel_mse"][0].get<double>(), 0.1);
    const Outcome other =
        run("chart " + cornell_box + " --size 16x16 --spp 4 --reference " + path("r.exr") + " -o " +
            path("d"));
    EXPECT_EQ(other.exit_code, 1);
    EXPECT_THAT(other.words, HasSubstr("has 32 x 32 pixels, and the picture 16 x 16"));
}

// By a pilot's time, of which a test can say no more than that there are that many points.
TEST_F(ChartCommand, TakesTimes) {
    const Outcome outcome =
        run("chart " + cornell_box + " --size 16x16 --times .02,.01 --seeds 2 --methods mis -o " +
            path("d"));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.words;
    const nlohmann::json points = json("d/chart.json")["variants"][0]["points"];
    ASSERT_GE(points.size(), 1U);
    ASSERT_LE(points.size(), 2U);
    if (points.size() == 2) {
        EXPECT_NEAR(points[1]["samples"].get<double>() / points[0]["samples"].get<double>(), 2, 1);
    }
}

// `path` finds no point light: with a lamp beside it is biased, without it is left out.
TEST_F(ChartCommand, TellsWhatAMethodCannotFind) {
    const auto scene = [&](const char* name, bool has_lamp) {
        nlohmann::json gltf = nlohmann::json::parse(std::ifstream(cornell_box));
        gltf["extensionsUsed"].push_back("KHR_lights_punctual");
        gltf["extensions"]["KHR_lights_punctual"]["lights"] = {
            {{"type", "point"}, {"intensity", 2.0}}};
        gltf["nodes"].push_back(
            {{"translation", {0.0, 0.5, 0.3}},
             {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
        gltf["scenes"][0]["nodes"].push_back(gltf["nodes"].size() - 1);
        if (!has_lamp)
            for (nlohmann::json& material : gltf["materials"]) material.erase("emissiveFactor");
        return folder.write(name, gltf.dump()).string();
    };
    const std::string rest = " --size 32x32 --spp 64 --seeds 3 --methods mis,path -o ";
    ASSERT_EQ(run("chart " + scene("a.gltf", true) + rest + path("a")).exit_code, 0);
    const nlohmann::json both = json("a/chart.json")["variants"];
    EXPECT_EQ(both[0]["verdict"], "sound");
    EXPECT_EQ(both[1]["verdict"], "biased");
    EXPECT_EQ(both[1]["bias"], "");
    const Outcome outcome = run("chart " + scene("b.gltf", false) + rest + path("b"));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.words;
    EXPECT_THAT(outcome.words, HasSubstr("\"path\""));
    EXPECT_THAT(outcome.words, HasSubstr("it is left out"));
    EXPECT_EQ(json("b/chart.json")["variants"].size(), 1U);
}

// Values with commas in them are no variants of their own.
TEST_F(ChartCommand, KeepsCommasOfValues) {
    const Outcome outcome = chart("--methods 'path --splits 1,1,2,mis' --spp 4");
    ASSERT_EQ(outcome.exit_code, 1);  // --spp stands there twice
    const Outcome one =
        run("chart " + cornell_box +
            " --size 16x16 --spp 4 --seeds 2 --reference-spp 16 --methods 'path --splits "
            "1,1,2,mis' -o " +
            path("d"));
    ASSERT_EQ(one.exit_code, 0) << one.words;
    const nlohmann::json variants = json("d/chart.json")["variants"];
    ASSERT_EQ(variants.size(), 2U);
    EXPECT_EQ(variants[0]["label"], "path --splits 1,1,2");
    EXPECT_EQ(variants[1]["label"], "mis");
}

}  // namespace
}  // namespace wavepath
