// An estimator as data: the lecture notes' methods, their terminations, and the cures
// (docs/methods.md).
#pragma once

#include "prepare/light_tables.h"

#include <cstdint>
#include <string>
#include <vector>

namespace wavepath {

// How a path is given its next stop in a medium (docs/methods.md). Numbered as DISTANCE_* of
// kernels/shared/features.h.
enum class Distances { exponential, uniform, truncated, equiangular, mis };

// Of each of Distances, in order.
const std::vector<std::string>& distance_names();
// Throws Error for a name that is none of them.
Distances distances_named(const std::string& name);
std::string name_of(Distances distances);

struct Method {
    std::string name;
    bool sample_lights =
        false;  // choose points on lights; emission met by chance counts only where that cannot
    bool sample_lobes = false;  // directions follow the bsdf; else uniform in projected solid angle
    bool weigh_both = false;    // both, by the power heuristic
    bool guide = false;  // some directions are aimed at the lamps' surroundings; needs weigh_both
    LightChoice light_choice = LightChoice::area;
    Distances distances = Distances::exponential;
    bool phase_directions = true;  // in media directions follow the phase function; else uniform
};

// path, direct, bsdf, direct-bsdf, mis.
const std::vector<Method>& methods();

// Throws Error for a name that is none of them.
const Method& method_named(const std::string& name);

enum class TerminationKind { zero, depth, roulette, roulette_constant };

struct Termination {
    TerminationKind kind = TerminationKind::roulette;
    uint32_t depth = 0;  // of `depth`: most scatterings between camera and light
    float survival = 1;  // of `roulette_constant`: chance to go on

    std::string text() const;  // as the command line spells it
    // What it does to the expected value; empty: nothing.
    std::string bias() const;
};

// "zero", "depth:D" with D >= 0, "roulette", "roulette:q" with 0 < q <= 1. Throws Error for
// anything else.
Termination parse_termination(const std::string& text);

// Into how many a path branches.
struct Splits {
    uint32_t stops = 1;        // N: on a segment in a medium
    uint32_t directions = 1;   // M: from each
    uint32_t reflections = 1;  // S: from a surface point
};

// "N,M" or "N,M,S". Throws Error for anything else.
Splits parse_splits(const std::string& text);

}  // namespace wavepath
