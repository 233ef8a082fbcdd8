// A closed room whose walls reflect rho and emit 1: L = 1 / (1 - rho). How paths end decides.
#include "commands/stress/situation.h"
#include "scene/shapes.h"

#include <fmt/format.h>

#include <cmath>

namespace wavepath {

namespace {

Situation in_furnace(Effort effort, double rho, const Termination& termination) {
    Situation s;
    s.family = "A closed room that emits";
    s.abscissa = "albedo of the walls";
    s.x = rho;
    s.method = "--termination " + termination.text();
    s.scene = scene_named(s.family);
    const auto albedo = static_cast<float>(rho);
    add_box(s.scene, lambert(grey(albedo), grey(1)), {-1, -1, -1}, {1, 1, 1}, Facing::inward);
    s.settings = sampled_once(effort, "path", perspective({0.2, 0.1, 0.3}, {-1, -0.4, -0.9}, 1.6));
    s.settings.termination = termination;
    s.truth = 1 / (1 - double{albedo});
    if (termination.kind == TerminationKind::depth) {
        s.relative_variance = 0;
        // What is cut off, against what a mean of floats may be off by.
        const double missing = std::pow(rho, termination.depth + 1);
        if (missing > s.truth_error) s.expected = Verdict::biased;
        return s;
    }
    // Of `roulette` nothing is predicted: it spares the first scatterings. With the chance q to go
    // on E X^2 / (E X)^2 = (1 - rho^2) / (1 - rho^2 / q), infinite from q = rho^2 down.
    if (termination.kind == TerminationKind::roulette) return s;
    const double q = termination.survival;
    if (q > rho * rho)
        s.relative_variance = (1 - rho * rho) / (1 - rho * rho / q) - 1;
    else
        s.expected = Verdict::infinite_variance;
    return s;
}

}  // namespace

std::vector<Situation> furnace_situations(Effort effort) {
    std::vector<Situation> situations;
    for (const char* how :
         {"roulette", "roulette:0.5", "roulette:0.7", "roulette:0.9", "depth:5", "depth:40",
          "depth:200"})
        for (const double rho : {0.5, 0.8, 0.9})
            situations.push_back(in_furnace(effort, rho, parse_termination(how)));
    return situations;
}

}  // namespace wavepath
