// `wavepath render` as a user meets it.
#pragma once

#include "support/command.h"

#include <algorithm>
#include <filesystem>

namespace wavepath {

class RenderCommand : public CommandTest {
  protected:
    // It fails with one line that holds `words`, and leaves no picture.
    void expect_refused(const std::string& arguments, const std::string& words) const {
        SCOPED_TRACE(arguments);
        const std::string picture = path("refused.exr");
        const Outcome outcome = run("render " + arguments + " --quiet -o " + picture);
        EXPECT_EQ(outcome.exit_code, 1);
        EXPECT_NE(outcome.words.find(words), std::string::npos) << outcome.words;
        EXPECT_EQ(std::ranges::count(outcome.words, '\n'), 1) << outcome.words;
        EXPECT_FALSE(std::filesystem::exists(picture));
    }
};

}  // namespace wavepath
