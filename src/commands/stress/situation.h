// A situation in which an estimator lives or dies, with what is known of it in closed form.
#pragma once

#include "wavefront/renderer.h"

#include <optional>
#include <string>
#include <vector>

namespace wavepath {

enum class Verdict { sound, noisy, infinite_variance, biased };

std::string name_of(Verdict verdict);

// One cell of a matrix. All pixels of its picture have one expected value, or are pooled where the
// mean over the picture is what is known.
struct Situation {
    std::string family;    // the matrix, a sentence
    std::string abscissa;  // what its rows vary, with unit
    double x = 0;          // the row
    std::string method;    // the column, as the command line spells it
    Scene scene;
    RenderSettings settings;                  // independent samples; width and height say how many
    double truth = 0;                         // radiance of every channel
    double truth_error = 1e-5;                // relative: of the truth itself, and of rounding
    std::optional<double> relative_variance;  // of one sample [1], as predicted
    Verdict expected = Verdict::sound;
};

// How much is done: `quick` takes 2^16 samples a cell, else 2^20.
enum class Effort { quick, whole };

// Settings of one independent sample a pixel for so many pixels, all looking through `camera`.
RenderSettings sampled_once(Effort effort, const std::string& method, const Camera& camera);

// The families, each by the file of its name.
std::vector<Situation> light_situations(Effort effort);
std::vector<Situation> furnace_situations(Effort effort);
std::vector<Situation> medium_situations(Effort effort);
std::vector<Situation> lobe_situations(Effort effort);
std::vector<Situation> place_situations(Effort effort);

}  // namespace wavepath
