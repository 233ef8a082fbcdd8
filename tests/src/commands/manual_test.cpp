#include "commands/manual.h"

#include "support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <CLI/CLI.hpp>

#include <cstdlib>
#include <string>

namespace wavepath {
namespace {

using testing::HasSubstr;
using testing::Not;

// A small table with one option of each kind.
class Manual : public testing::Test {
  protected:
    Manual() {
        app.set_version_flag("--version", "toy 1.2");
        app.add_flag("--secret")->group("");
        app.footer("Exit status: 0\n.. dots stay");
        CLI::App* render = app.add_subcommand("render", "Renders a scene to a file's path");
        render->add_option("scene", text, "glTF file")->required()->option_text("SCENE.gltf|.glb");
        render->add_option("-o,--output", text, "picture")->option_text("OUT.exr");
        render->add_option("--method", text, "estimator")->check(CLI::IsMember({"mis", "path"}));
        render->add_option("--termination", text)->option_text("zero|depth:D|roulette[:q]");
        render->add_option("--env", text)->check(CLI::ExistingFile);
        render->add_option("--spp", number, "samples a pixel")
            ->capture_default_str()
            ->type_name("N")
            ->check(CLI::Range(1, 99));
        render->add_option_group("devices")
            ->add_option("--device", text, "where")
            ->type_name("SELECTOR");
        app.add_subcommand("devices", "Lists devices")->add_flag("--json", flag, "as JSON");
        app.add_subcommand("probe", "for internal use")->group("");
    }

    // What bash offers for a command line whose last word is being typed, joined by spaces.
    std::string completions(const std::string& words) const {
        const auto script = folder.write("completion", bash_completion(app));
        const std::string command =
            "cd " + folder.path().string() + " && bash -c '. " + script.string() +
            "; COMP_WORDS=(toy " + words +
            "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _toy; echo ${COMPREPLY[@]}' > out 2>&1";
        EXPECT_EQ(std::system(command.c_str()), 0) << folder.read("out");
        const std::string line = folder.read("out");
        return line.substr(0, line.find('\n'));
    }

    std::string text;
    int number = 64;
    bool flag = false;
    CLI::App app{"a toy of a program", "toy"};
    TemporaryFolder folder;
};

TEST_F(Manual, PageHoldsTheOptionTable) {
    const std::string page = man_page(app);
    EXPECT_THAT(page, HasSubstr(".TH TOY 1 \"\" \"toy 1.2\""));
    EXPECT_THAT(page, HasSubstr(".SH NAME\ntoy \\- a toy of a program\n"));
    EXPECT_THAT(
        page, HasSubstr("\\fBtoy\\fR \\fBrender\\fR \\fISCENE.gltf|.glb\\fR [\\fIoptions\\fR]"));
    EXPECT_THAT(page, HasSubstr("\\fB\\-o, \\-\\-output\\fR \\fIOUT.exr\\fR\npicture\n"));
    EXPECT_THAT(page, HasSubstr("\\fB\\-\\-method\\fR \\fImis|path\\fR\nestimator\n"));
    EXPECT_THAT(page, HasSubstr("\\fB\\-\\-spp\\fR \\fIN\\fR\nsamples a pixel [default: 64]\n"));
    EXPECT_THAT(page, HasSubstr("\\fB\\-\\-device\\fR \\fISELECTOR\\fR\nwhere\n"));
    EXPECT_THAT(page, HasSubstr("\\fB\\-\\-json\\fR\nas JSON\n"));
}

TEST_F(Manual, PageLeavesOutWhatIsHidden) {
    EXPECT_THAT(man_page(app), Not(HasSubstr("secret")));
    EXPECT_THAT(man_page(app), Not(HasSubstr("internal")));
}

TEST_F(Manual, PageEscapesWhatRoffWouldRead) {
    EXPECT_THAT(man_page(app), HasSubstr("Renders a scene to a file\\(aqs path"));
    EXPECT_THAT(man_page(app), HasSubstr("\n\\&.. dots stay\n"));
}

TEST_F(Manual, PageIsCleanRoff) {
    if (std::system("command -v groff > /dev/null 2>&1") != 0)
        GTEST_SKIP() << "groff is not installed";
    const std::string page = folder.write("toy.1", man_page(app));
    ASSERT_EQ(std::system(("groff -man -ww -z " + page + " 2> " + page + ".log").c_str()), 0);
    EXPECT_EQ(folder.read("toy.1.log"), "");
}

TEST_F(Manual, CompletesCommands) {
    EXPECT_EQ(completions("\"\""), "render devices -h --help --version");
    EXPECT_EQ(completions("dev"), "devices");
}

TEST_F(Manual, CompletesOptionsOfTheCommand) {
    EXPECT_EQ(completions("render --d"), "--device");
    EXPECT_EQ(completions("devices --j"), "--json");
}

TEST_F(Manual, CompletesChoices) {
    EXPECT_EQ(completions("render --method \"\""), "mis path");
    EXPECT_EQ(completions("render --termination \"\""), "zero");
    EXPECT_EQ(completions("render --spp \"\""), "");
}

TEST_F(Manual, CompletesFiles) {
    const auto scene = folder.write("box.gltf", "");
    EXPECT_EQ(completions("render bo"), "box.gltf");
    EXPECT_EQ(completions("render --env bo"), "box.gltf");
    EXPECT_EQ(completions("render -o bo"), "box.gltf");
}

}  // namespace
}  // namespace wavepath
