#include "wavefront/sample_warnings.h"

#include <fmt/format.h>

#include <cmath>

namespace wavepath {

void warn_of_samples(
    RenderResult& result, const std::string& scene, uint64_t pixels, bool gains_energy) {
    const double samples = static_cast<double>(result.samples) * static_cast<double>(pixels);
    if (auto warning = outlier_warning(result.outlier, samples, gains_energy))
        result.warnings.push_back(*std::move(warning));
    if (result.film.nonfinite.of_media)
        result.warnings.push_back(fmt::format(
            "{}: samples are not finite where more than 4 media lie around one another, "
            "or meet in a plane; take one of them away if any do",
            scene));
    else if (result.film.nonfinite.samples > 0 && gains_energy)
        result.warnings.emplace_back(
            "samples are not finite: by --layering specification dielectrics gain energy, without "
            "bound in closed scenes; use --layering conserving");
    else if (result.film.nonfinite.samples > 0)
        result.warnings.push_back(fmt::format(
            "{}: samples are not finite, and why is not known; dim lights whose radiance may "
            "exceed 32 bits, else report the scene",
            scene));
    else if (result.batches > 1 && !std::isfinite(result.film.relative_error))
        result.warnings.emplace_back(
            "the variance layer is not finite: squares of the radiance exceed 32 bits; dim the "
            "lights");
}

}  // namespace wavepath
