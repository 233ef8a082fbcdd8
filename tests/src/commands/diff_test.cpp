#include "image/exr_writer.h"
#include "support/command.h"
#include "support/noisy_pictures.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

namespace wavepath {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class DiffCommand : public CommandTest {
  protected:
    void SetUp() override {
        write("truth", truth);
        write("a", noisy_picture(truth, 0.1, 1));
        write("b", noisy_picture(truth, 0.1, 2));
    }

    void write(const std::string& name, const Image& image) const {
        write_exr(image, folder / (name + ".exr"));
    }

    Outcome diff(
        const std::string& a, const std::string& b, const std::string& options = "") const {
        return run("diff " + path(a + ".exr") + " " + path(b + ".exr") + " " + options);
    }

    Image truth = lamp_picture(64);
};

TEST_F(DiffCommand, FindsNothingBetweenSeeds) {
    const Outcome outcome = diff("a", "b", "--json " + path("diff.json"));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.words;
    EXPECT_THAT(
        outcome.words,
        AllOf(
            HasSubstr("MSE of "), HasSubstr("relMSE of "), HasSubstr("ratio of means: "),
            HasSubstr("pixels of the same bits: 0 %"), HasSubstr("no difference found")));
    const auto report = json("diff.json");
    EXPECT_EQ(report["schema"], "wavepath diff");
    EXPECT_EQ(report["differ"], false);
    EXPECT_GT(report["p_same_expectation"], 0.01);
    EXPECT_EQ(report["errors"].size(), 1U);
    // Both have a relative variance of 0.01, of which 0.01 in the denominator leaves 93 %. A mean
    // over 12288 values is known to 2 %; the noise in the denominator adds 3 %.
    EXPECT_NEAR(report["errors"][0]["rel_mse"].get<double>(), 0.0192, 0.0018);
}

TEST_F(DiffCommand, EndsWith3WhereExpectationsDiffer) {
    for (auto& [name, plane] : truth.channels)
        for (float& value : plane) value *= 1.05F;
    write("b", noisy_picture(truth, 0.1, 2));
    const Outcome outcome = diff("a", "b", "--json " + path("diff.json"));
    EXPECT_EQ(outcome.exit_code, 3) << outcome.words;
    EXPECT_THAT(outcome.words, HasSubstr("the expectations differ"));
    EXPECT_EQ(json("diff.json")["differ"], true);
}

TEST_F(DiffCommand, OfAPictureAndItselfIsNothing) {
    const Outcome outcome = diff("a", "a");
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_THAT(
        outcome.words, AllOf(HasSubstr("bits: 100 %"), HasSubstr("ratio of means: 1 +- 0\n")));
}

TEST_F(DiffCommand, MeasuresBothAgainstAReference) {
    diff("a", "truth", "--reference " + path("truth.exr") + " --json " + path("diff.json"));
    const auto errors = json("diff.json")["errors"];
    ASSERT_EQ(errors.size(), 2U);
    EXPECT_NEAR(errors[0]["rel_mse"].get<double>(), 0.0093, 0.0009);
    EXPECT_EQ(errors[1]["rel_mse"], 0);
}

TEST_F(DiffCommand, SaysInOneLineWhatCannotBeCompared) {
    write("small", lamp_picture(32));
    Image grey = truth;
    grey.channels.erase("G");
    write("grey", grey);
    for (const auto& [name, reason] :
         {std::pair{"small", "has 64 x 64 pixels and"}, std::pair{"grey", "has no channel G"},
          std::pair{"none", "cannot be read"}}) {
        const Outcome outcome = diff("a", name, "--json " + path("diff.json"));
        EXPECT_EQ(outcome.exit_code, 1);
        EXPECT_THAT(outcome.words, HasSubstr(reason));
        EXPECT_EQ(std::ranges::count(outcome.words, '\n'), 1) << outcome.words;
        EXPECT_FALSE(std::filesystem::exists(path("diff.json")));
    }
}

TEST_F(DiffCommand, LeavesOutWhatIsNotFinite) {
    Image broken = truth;
    broken.channels["R"][5] = std::numeric_limits<float>::quiet_NaN();
    write("broken", broken);
    const Outcome outcome = diff("truth", "broken");
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_THAT(outcome.words, HasSubstr("pixels left out, not finite: 1\n"));
}

TEST_F(DiffCommand, WritesAPageWithTheCommandsBehindThePictures) {
    const std::string options = " --size 32x32 --spp 8 --look-at 0,1,4,0,1,0 --fov 40 --quiet -o ";
    ASSERT_EQ(run("render " + cornell_box + options + path("a.exr")).exit_code, 0);
    ASSERT_EQ(run("render " + cornell_box + " --seed 2" + options + path("b.exr")).exit_code, 0);
    const Outcome outcome = diff("a", "b", "-o " + path("page"));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.words;
    EXPECT_THAT(outcome.words, HasSubstr("exact: one set of options"));
    for (const char* file : {"a.png", "b.png", "difference.png", "z.png"})
        EXPECT_TRUE(std::filesystem::exists(folder / "page" / file)) << file;
    const std::string page = folder.read("page/index.html");
    EXPECT_THAT(page, AllOf(HasSubstr("relMSE of "), HasSubstr("no difference found")));
    EXPECT_THAT(page, Not(HasSubstr("http")));
    // Of a command on the page the picture comes out again.
    const std::size_t begin = page.find("render " + cornell_box);
    const std::string command = page.substr(begin, page.find('<', begin) - begin);
    EXPECT_THAT(command, HasSubstr("--spp 8 --seed 1"));
    ASSERT_EQ(run(command + " --quiet -o " + path("again.exr")).exit_code, 0) << command;
    EXPECT_THAT(diff("a", "again").words, HasSubstr("bits: 100 %"));
}

}  // namespace
}  // namespace wavepath
