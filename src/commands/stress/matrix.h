// Judgements side by side, method by situation, as a page and as JSON.
#pragma once

#include "commands/stress/judge.h"

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace wavepath {

struct Cell {
    Situation situation;  // without its scene
    Judgement judgement;

    bool as_expected() const { return judgement.verdict == situation.expected; }
};

// "mean 0.98 +- 0.01, rv 3.2 (3.18)": relative to the truth, relative variance of one sample, and
// that as predicted; where the variance is infinite the tail's index and the error's slope.
std::string words_of(const Cell& cell);

// Schema 1 of docs/stress.md.
nlohmann::ordered_json json_of(const std::vector<Cell>& cells, const std::string& device);

// index.html in `folder`. Throws Error where it cannot be written, or gnuplot is missing.
void write_matrix(
    const std::vector<Cell>& cells, const std::string& device, const std::filesystem::path& folder);

}  // namespace wavepath
