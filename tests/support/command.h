// The program as a user meets it, for tests of its commands.
#pragma once

#include "build_paths.h"
#include "support/temporary_folder.h"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>

namespace wavepath {

inline const std::string cornell_box = WAVEPATH_SOURCE_DIR "/scenes/cornell_box/scene.gltf";

struct Outcome {
    int exit_code;
    std::string words;  // what it printed, both streams
};

class CommandTest : public testing::Test {
  protected:
    // `before`: variables of its environment, NAME=value.
    Outcome run(const std::string& arguments, const std::string& before = "") const {
        const int status = std::system(
            ("{ " + before + " " WAVEPATH_BINARY " " + arguments + "; } > " + path("log") + " 2>&1")
                .c_str());
        return {WEXITSTATUS(status), folder.read("log")};
    }

    nlohmann::json json(const std::string& name) const {
        return nlohmann::json::parse(folder.read(name));
    }

    std::string path(const std::string& name) const { return (folder / name).string(); }

    TemporaryFolder folder;
};

}  // namespace wavepath
