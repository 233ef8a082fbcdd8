#include "scene/gltf_medium.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace wavepath {
namespace {

constexpr const char* extras_key = "wavepath_medium";

// Henyey-Greenstein beyond this is a delta in single precision.
constexpr double largest_anisotropy = 0.99999;

class MediumReader {
  public:
    MediumReader(const GltfFile& file, int index)
        : file_(file),
          source_(file.model.materials[static_cast<std::size_t>(index)]),
          where_(label("material", index, source_.name)) {}

    bool has_extras() const { return source_.extras.IsObject() && source_.extras.Has(extras_key); }

    double transmission() const {
        return extension_number("KHR_materials_transmission", "transmissionFactor", 0);
    }

    double thickness() const {
        return extension_number("KHR_materials_volume", "thicknessFactor", 0);
    }

    Medium read() const { return has_extras() ? from_extras() : from_volume(); }

    template <typename... Args>
    [[noreturn]] void fail(fmt::format_string<Args...> message, Args&&... args) const {
        file_.fail(where_, message, std::forward<Args>(args)...);
    }

  private:
    double extension_number(const char* extension, const char* key, double missing) const {
        const auto* found = find_extension(source_.extensions, extension);
        return found ? number(file_, where_, *found, key, missing) : missing;
    }

    // sigma_a = -ln(attenuationColor) / attenuationDistance
    Medium from_volume() const {
        Medium medium;
        const auto* volume = find_extension(source_.extensions, "KHR_materials_volume");
        const double distance = number(
            file_, where_, *volume, "attenuationDistance", std::numeric_limits<double>::infinity());
        if (!(distance > 0)) fail("attenuationDistance is {}; it has to be above 0 [m]", distance);
        const std::vector<double> color =
            numbers(file_, where_, *volume, "attenuationColor", {1, 1, 1});
        if (color.size() != 3)
            fail("attenuationColor has {} numbers instead of 3; repair it", color.size());
        for (std::size_t c = 0; c < 3; ++c) {
            if (!(color[c] >= 0 && color[c] <= 1))
                fail("attenuationColor holds {}, not in 0 .. 1; repair it", color[c]);
            // black absorbs everything: as much as single precision can tell from nothing
            const double kept = std::max(color[c], 1e-37);
            medium.sigma_a[c] = static_cast<float>(-std::log(kept) / distance);
        }
        return medium;
    }

    Medium from_extras() const {
        const tinygltf::Value& extras = source_.extras.Get(extras_key);
        if (!extras.IsObject()) fail("extras.{} is not an object; see docs/media.md", extras_key);
        for (const std::string& key : extras.Keys())
            if (key != "sigma_a" && key != "sigma_s" && key != "emission" && key != "g")
                fail(
                    "extras.{} has no member \"{}\"; use sigma_a, sigma_s, g, emission", extras_key,
                    one_line(key));
        Medium medium;
        medium.sigma_a = coefficients(extras, "sigma_a");
        medium.sigma_s = coefficients(extras, "sigma_s");
        medium.emission = coefficients(extras, "emission");
        const double g = number(file_, where_, extras, "g", 0);
        if (!(std::abs(g) <= largest_anisotropy))
            fail(
                "extras.{}: g is {}, not in -{} .. {}", extras_key, g, largest_anisotropy,
                largest_anisotropy);
        medium.anisotropy = static_cast<float>(g);
        return medium;
    }

    Rgb coefficients(const tinygltf::Value& object, const char* key) const {
        const std::vector<double> values = numbers(file_, where_, object, key, {0, 0, 0});
        if (values.size() != 3)
            fail("extras.{}: {} has {} numbers instead of 3", extras_key, key, values.size());
        Rgb rgb;
        for (std::size_t c = 0; c < 3; ++c) {
            if (!(values[c] >= 0 && values[c] <= std::numeric_limits<float>::max()))
                fail("extras.{}: {} holds {}; it has to be 0 or more", extras_key, key, values[c]);
            rgb[c] = static_cast<float>(values[c]);
        }
        return rgb;
    }

    const GltfFile& file_;
    const tinygltf::Material& source_;
    std::string where_;
};

}  // namespace

void read_medium(const GltfFile& file, int index, Material& material, Ignored& ignored) {
    const MediumReader reader(file, index);
    const double transmission = reader.transmission();
    const bool encloses = transmission > 0 && reader.thickness() > 0;
    if (reader.has_extras() && !encloses)
        reader.fail(
            "extras.{} needs KHR_materials_transmission with transmissionFactor above 0 and "
            "KHR_materials_volume with thicknessFactor above 0; add them",
            extras_key);
    if (!(transmission > 0)) return;
    if (!encloses)
        ignored.add("thin transmitting materials", "rendered opaque");
    else if (transmission < 1 || material.metallic > 0)
        ignored.add("volumes that transmit in part", "rendered opaque");
    else if (material.ior != 1)
        ignored.add("volumes that refract (ior not 1)", "rendered opaque");
    else if (material.emits())
        reader.fail("is a boundary with ior 1 and emits; take emissiveFactor or the volume away");
    else {
        material.boundary = Boundary::index_matched;
        material.medium = reader.read();
    }
}

}  // namespace wavepath
