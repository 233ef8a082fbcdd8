// How files are broken at random.
#pragma once

#include <cstddef>
#include <random>
#include <string>

namespace wavepath {

using Random = std::mt19937;

// Evenly among 0 .. end - 1.
std::size_t below(Random& random, std::size_t end);

void break_bytes(std::string& bytes, Random& random);

// Breaks the JSON of `bytes` and keeps the lengths of a .glb right.
void break_json_of(std::string& bytes, Random& random);

}  // namespace wavepath
