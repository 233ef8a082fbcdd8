#include "gltf/gltf_medium.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

namespace wavepath {
namespace {

constexpr const char* extras_key = "wavepath_medium";

// The names that the drafts' multi-scatter albedo has had, the latest first (2026, 2025, 2024).
constexpr const char* albedo_spellings[] = {
    "multiscatterColorFactor", "multiscatterColor", "scatterAlbedo"};

constexpr const char* scatter_extensions[] = {
    "KHR_materials_scatter", "KHR_materials_volume_scatter"};

// Henyey-Greenstein beyond this is a delta in single precision.
constexpr double largest_anisotropy = 0.99999;

// The single-scattering albedo under which a half-space of this anisotropy has the multi-scatter
// albedo `rho`: 1 - s^2 with s the bracket of KHR_materials_volume_scatter for g = 0, and
// (1 - s^2) / (1 - g s^2) of KHR_materials_scatter. The fit leaves 6e-6 at rho = 0, where nothing
// scatters.
double single_albedo(double rho, double g) {
    const double s =
        4.09712 + 4.20863 * rho - std::sqrt(9.59217 + 41.6808 * rho + 17.7126 * rho * rho);
    return rho > 0 ? std::clamp((1 - s * s) / (1 - g * s * s), 0.0, 1.0) : 0.0;
}

bool is_named_like_ours(const std::string& key) {
    constexpr std::string_view ours = "wavepath";
    const auto same = [](unsigned char a, char b) { return std::tolower(a) == b; };
    return std::ranges::mismatch(key, ours, same).in2 == ours.end();
}

bool has_medium(const tinygltf::Value& extras) {
    return extras.IsObject() && extras.Has(extras_key);
}

class MediumReader {
  public:
    MediumReader(const GltfFile& file, int index)
        : file_(file),
          source_(file.model.materials[static_cast<std::size_t>(index)]),
          where_(label("material", index, source_.name)) {}

    bool has_extras() const { return has_medium(source_.extras); }

    double transmission() const {
        return extension_number("KHR_materials_transmission", "transmissionFactor", 0);
    }

    double thickness() const {
        const double factor = extension_number("KHR_materials_volume", "thicknessFactor", 0);
        if (!(factor >= 0)) fail("thicknessFactor is {}; it has to be 0 or more", factor);
        return factor;
    }

    Medium read() const { return has_extras() ? from_extras() : from_volume(); }

    bool scatters() const {
        return std::ranges::any_of(scatter_extensions, [&](const char* name) {
            return find_extension(source_.extensions, name) != nullptr;
        });
    }

    bool has_scatter_textures() const {
        if (has_extras()) return false;
        for (const char* name : scatter_extensions) {
            const auto* extension = find_extension(source_.extensions, name);
            if (extension && std::ranges::any_of(extension->Keys(), [](const std::string& key) {
                    return key.ends_with("Texture");
                }))
                return true;
        }
        return false;
    }

    // Members of the scattering extensions, and of extras under this program's name, that mean
    // nothing here.
    std::vector<std::string> unknown_members() const {
        std::vector<std::string> unknown;
        if (source_.extras.IsObject())
            for (const std::string& key : source_.extras.Keys())
                if (is_named_like_ours(key) && key != extras_key)
                    unknown.push_back(fmt::format("extras.{}", one_line(key)));
        if (has_extras()) return unknown;
        for (const char* name : scatter_extensions) {
            const auto* extension = find_extension(source_.extensions, name);
            if (extension == nullptr) continue;
            for (const std::string& key : extension->Keys())
                if (std::ranges::find(albedo_spellings, key) == std::end(albedo_spellings) &&
                    key != "scatterAnisotropy" && key != "scatterStrengthFactor" &&
                    !key.ends_with("Texture") && key != "extras" && key != "extensions")
                    unknown.push_back(fmt::format("{}.{}", name, one_line(key)));
        }
        return unknown;
    }

    // What keeps the material from enclosing the medium of its extras; nothing if nothing does.
    std::string missing_for_extras(const Material& material) const {
        if (!(transmission() > 0))
            return "KHR_materials_transmission with transmissionFactor above 0";
        if (!(thickness() > 0)) return "KHR_materials_volume with thicknessFactor above 0";
        if (material.is_metal()) return "metallicFactor below 1, or a metallicRoughnessTexture";
        if (material.ior < 1) return "an ior of 1 or more";
        return material.unlit ? "no KHR_materials_unlit" : "";
    }

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
            const double sigma = -std::log(kept) / distance;
            if (sigma > std::numeric_limits<float>::max())
                fail(
                    "attenuationDistance is {} m, too short for single precision; raise it",
                    distance);
            medium.sigma_a[c] = static_cast<float>(sigma);
        }
        if (const auto* newer = find_extension(source_.extensions, "KHR_materials_scatter"))
            scatter(
                medium, *newer, number(file_, where_, *newer, "scatterStrengthFactor", 0),
                {1, 1, 1}, true);
        else if (
            const auto* older = find_extension(source_.extensions, "KHR_materials_volume_scatter"))
            scatter(medium, *older, 1, {0, 0, 0}, false);
        return medium;
    }

    // What attenuates also scatters: sigma_t stays, and its share of the single-scattering albedo
    // is sigma_s.
    void scatter(
        Medium& medium,
        const tinygltf::Value& extension,
        double strength,
        const std::vector<double>& missing,
        bool albedo_knows_anisotropy) const {
        const auto* spelling = std::ranges::find_if(
            albedo_spellings, [&](const char* name) { return extension.Has(name); });
        const char* key = spelling == std::end(albedo_spellings) ? albedo_spellings[0] : *spelling;
        const std::vector<double> color = numbers(file_, where_, extension, key, missing);
        if (color.size() != 3) fail("{} has {} numbers instead of 3; repair it", key, color.size());
        const double g = number(file_, where_, extension, "scatterAnisotropy", 0);
        if (!(std::abs(g) <= largest_anisotropy))
            fail(
                "scatterAnisotropy is {}, not in -{} .. {}; repair it", g, largest_anisotropy,
                largest_anisotropy);
        medium.anisotropy = static_cast<float>(g);
        for (std::size_t c = 0; c < 3; ++c) {
            const double rho = strength * color[c];
            if (!(rho >= 0 && rho <= 1))
                fail("{} times the scatter strength is {}, not in 0 .. 1; repair it", key, rho);
            const double share = single_albedo(rho, albedo_knows_anisotropy ? g : 0);
            const double sigma_t = medium.sigma_a[c];
            medium.sigma_s[c] = static_cast<float>(share * sigma_t);
            medium.sigma_a[c] = static_cast<float>((1 - share) * sigma_t);
        }
    }

    Medium from_extras() const {
        const tinygltf::Value& extras = source_.extras.Get(extras_key);
        if (!extras.IsObject())
            fail(
                "extras.{} is not an object; write one of sigma_a, sigma_s, g, emission",
                extras_key);
        for (const std::string& key : extras.Keys())
            if (key != "sigma_a" && key != "sigma_s" && key != "emission" && key != "g")
                fail(
                    "extras.{} has no member \"{}\"; use sigma_a, sigma_s, g, emission", extras_key,
                    one_line(key));
        Medium medium;
        medium.sigma_a = coefficients(extras, "sigma_a");
        medium.sigma_s = coefficients(extras, "sigma_s");
        medium.emission = coefficients(extras, "emission");
        const double g = number(file_, where_of_extras(), extras, "g", 0);
        if (!(std::abs(g) <= largest_anisotropy))
            fail(
                "extras.{}: g is {}, not in -{} .. {}; repair it", extras_key, g,
                largest_anisotropy, largest_anisotropy);
        medium.anisotropy = static_cast<float>(g);
        return medium;
    }

    std::string where_of_extras() const { return fmt::format("{}: extras.{}", where_, extras_key); }

    Rgb coefficients(const tinygltf::Value& object, const char* key) const {
        const std::vector<double> values =
            numbers(file_, where_of_extras(), object, key, {0, 0, 0});
        if (values.size() != 3)
            fail(
                "extras.{}: {} has {} numbers instead of 3; repair it", extras_key, key,
                values.size());
        Rgb rgb;
        for (std::size_t c = 0; c < 3; ++c) {
            constexpr float most = std::numeric_limits<float>::max();
            if (!(values[c] >= 0 && values[c] <= most))
                fail(
                    "extras.{}: {} holds {}, not in 0 .. {:.2g}; repair it", extras_key, key,
                    values[c], most);
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
    const bool is_volume = reader.transmission() > 0 && reader.thickness() > 0;
    const std::string missing = reader.missing_for_extras(material);
    if (reader.has_extras() && !missing.empty())
        reader.fail("extras.{} needs {}; repair it", extras_key, missing);
    for (const std::string& name : reader.unknown_members())
        ignored.add(fmt::format("members {}", name), "rendered as if they were not there");
    if (!is_volume && reader.scatters())
        ignored.add(
            "materials that scatter without a volume and transmission",
            "rendered as if they did not");
    if (is_volume && material.unlit)
        ignored.add("volumes of unlit materials", "rendered without them");
    if (!is_volume || material.unlit) return;
    if (material.is_metal())
        material.transmission = 0;
    else if (material.ior < 1)
        ignored.add("volumes that refract with ior 0", "rendered as thin walls");
    else if (material.ior == 1 && material.emits())
        reader.fail("is a boundary with ior 1 and emits; take emissiveFactor or the volume away");
    else {
        material.boundary = material.ior == 1 ? Boundary::index_matched : Boundary::dielectric;
        material.medium = reader.read();
        const bool attenuates = material.medium.scatters() || material.medium.sigma_a != Rgb{};
        if (reader.scatters() && !reader.has_extras() && !attenuates)
            ignored.add(
                "scattering of volumes without attenuationDistance",
                "rendered as if they were clear");
        if (material.alpha_mode != AlphaMode::opaque)
            ignored.add("alpha modes of volumes", "rendered as if they were OPAQUE");
        material.alpha_mode = AlphaMode::opaque;  // light could enter and not leave
        if (reader.has_scatter_textures())
            ignored.add("textures of what scatters in volumes", "rendered by the factors alone");
        const bool is_rough = material.boundary == Boundary::dielectric && material.roughness > 0;
        if (!is_rough && !material.transmits_in_part())
            material.textures[TEXTURE_METALLIC_ROUGHNESS] = {};
    }
}

void note_misplaced_media(const tinygltf::Model& model, Ignored& ignored) {
    std::size_t misplaced = 0;
    const auto look = [&](const tinygltf::Value& extras) { misplaced += has_medium(extras); };
    for (const tinygltf::Node& node : model.nodes) look(node.extras);
    for (const tinygltf::Mesh& mesh : model.meshes) {
        look(mesh.extras);
        for (const tinygltf::Primitive& primitive : mesh.primitives) look(primitive.extras);
    }
    for (const tinygltf::Material& material : model.materials)
        for (const auto& [name, extension] : material.extensions) {
            look(extension);
            if (extension.IsObject()) look(extension.Get("extras"));
        }
    if (misplaced > 0)
        ignored.add(
            fmt::format("members {} outside of extras of materials", extras_key),
            "rendered as if they were not there", misplaced);
}

}  // namespace wavepath
