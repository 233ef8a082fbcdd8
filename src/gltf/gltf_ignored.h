// Notes what a file asks for and the program does not do, so that each kind is said once.
#pragma once

#include <string>
#include <vector>

namespace wavepath {

class Ignored {
  public:
    // `what`: a plural, counted; `instead`: what happens.
    void add(const std::string& what, const std::string& instead, std::size_t count = 1);

    // "textures (5): rendered with the material factors alone"
    std::vector<std::string> lines() const;

  private:
    struct Kind {
        std::string what;
        std::string instead;
        std::size_t count;
    };
    std::vector<Kind> kinds_;  // in the order they were met
};

}  // namespace wavepath
