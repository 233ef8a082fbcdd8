#include "gltf/gltf_material.h"

#include "gltf/gltf_medium.h"
#include "gltf/gltf_texture.h"

#include <algorithm>
#include <limits>

namespace wavepath {
namespace {

// By so much factors may pass the ends of their range that were rounded on their way to the file.
constexpr double rounding = 1e-6;
constexpr double steepest = 1e6;  // of normal maps: its square is a float
constexpr double unbounded = std::numeric_limits<float>::max();

class MaterialReader {
  public:
    MaterialReader(const GltfFile& file, int index)
        : file_(file),
          source_(file.model.materials[static_cast<std::size_t>(index)]),
          where_(label("material", index, source_.name)) {}

    Material read() const {
        const auto& pbr = source_.pbrMetallicRoughness;
        Material material;
        material.name = source_.name;
        material.base_color = color("baseColorFactor", pbr.baseColorFactor, 1);
        material.metallic = factor("metallicFactor", pbr.metallicFactor, 1);
        material.roughness = factor("roughnessFactor", pbr.roughnessFactor, 1);
        material.double_sided = source_.doubleSided;
        read_emission(material);
        read_ior(material);
        read_specular(material);
        read_transmission(material);
        read_alpha(material);
        read_textures(material);
        if (find_extension(source_.extensions, "KHR_materials_unlit")) make_unlit(material);
        return material;
    }

  private:
    float factor(const char* name, double value, double most, double least = 0) const {
        if (!(value >= least - rounding && value <= most + rounding))
            file_.fail(
                where_, "{} is {}, not in {:g} .. {:g}; repair the material", name, value, least,
                most);
        return static_cast<float>(std::clamp(value, least, most));
    }

    Rgb color(const char* name, const std::vector<double>& values, double most) const {
        if (values.size() < 3)
            file_.fail(
                where_, "{} has {} numbers instead of 3; repair the material", name, values.size());
        return {
            factor(name, values[0], most), factor(name, values[1], most),
            factor(name, values[2], most)};
    }

    // glTF bounds emissiveFactor by 1, many files do not, and nothing here depends on it.
    void read_emission(Material& material) const {
        double strength = 1;
        if (const auto* extension =
                find_extension(source_.extensions, "KHR_materials_emissive_strength"))
            strength = number(file_, where_, *extension, "emissiveStrength", 1);
        std::vector<double> radiance = source_.emissiveFactor;
        for (double& channel : radiance) channel *= strength;
        material.emission = color("emissiveFactor * emissiveStrength", radiance, unbounded);
    }

    void read_ior(Material& material) const {
        const auto* extension = find_extension(source_.extensions, "KHR_materials_ior");
        if (!extension) return;
        const double ior = number(file_, where_, *extension, "ior", 1.5);
        material.ior = ior == 0 ? 0 : factor("ior", ior, unbounded, 1);
    }

    void read_specular(Material& material) const {
        const auto* extension = find_extension(source_.extensions, "KHR_materials_specular");
        if (!extension) return;
        material.specular =
            factor("specularFactor", number(file_, where_, *extension, "specularFactor", 1), 1);
        material.specular_color = color(
            "specularColorFactor",
            numbers(file_, where_, *extension, "specularColorFactor", {1, 1, 1}), unbounded);
    }

    void read_transmission(Material& material) const {
        const auto* extension = find_extension(source_.extensions, "KHR_materials_transmission");
        if (!extension) return;
        material.transmission = factor(
            "transmissionFactor", number(file_, where_, *extension, "transmissionFactor", 0), 1);
    }

    void read_alpha(Material& material) const {
        if (source_.alphaMode != "OPAQUE" && source_.alphaMode != "MASK" &&
            source_.alphaMode != "BLEND")
            file_.fail(
                where_, "alphaMode \"{}\" is unknown; use OPAQUE, MASK or BLEND",
                one_line(source_.alphaMode));
        material.alpha_mode = source_.alphaMode == "MASK"    ? AlphaMode::mask
                              : source_.alphaMode == "BLEND" ? AlphaMode::blend
                                                             : AlphaMode::opaque;
        const std::vector<double>& base = source_.pbrMetallicRoughness.baseColorFactor;
        if (base.size() > 3) material.alpha = factor("baseColorFactor", base[3], 1);
        material.alpha_cutoff = factor("alphaCutoff", source_.alphaCutoff, unbounded);
    }

    void read_textures(Material& material) const {
        const auto& pbr = source_.pbrMetallicRoughness;
        material.normal_scale =
            factor("normalTexture.scale", source_.normalTexture.scale, steepest, -steepest);
        TextureReader reader(file_, where_, material);
        reader.read(TEXTURE_BASE_COLOR, pbr.baseColorTexture, "baseColorTexture");
        reader.read(
            TEXTURE_METALLIC_ROUGHNESS, pbr.metallicRoughnessTexture, "metallicRoughnessTexture");
        reader.read(TEXTURE_NORMAL, source_.normalTexture, "normalTexture");
        reader.read(TEXTURE_EMISSION, source_.emissiveTexture, "emissiveTexture");
        if (const auto* extension = find_extension(source_.extensions, "KHR_materials_specular")) {
            reader.read(TEXTURE_SPECULAR, *extension, "specularTexture");
            reader.read(TEXTURE_SPECULAR_COLOR, *extension, "specularColorTexture");
        }
        if (const auto* extension =
                find_extension(source_.extensions, "KHR_materials_transmission"))
            reader.read(TEXTURE_TRANSMISSION, *extension, "transmissionTexture");
    }

    // To light a scene a colour that "is not affected by lighting" [KHR_materials_unlit] is one
    // that emits itself, to either side, and reflects nothing.
    static void make_unlit(Material& material) {
        material.unlit = true;
        material.emission = material.base_color;
        material.textures[TEXTURE_EMISSION] = material.texture(TEXTURE_BASE_COLOR);
        material.double_sided = true;
        material.base_color = {0, 0, 0};
        material.metallic = 0;
        material.specular = 0;
        material.transmission = 0;
        material.textures[TEXTURE_METALLIC_ROUGHNESS] = {};
        material.textures[TEXTURE_NORMAL] = {};
        material.textures[TEXTURE_SPECULAR] = {};
        material.textures[TEXTURE_SPECULAR_COLOR] = {};
        material.textures[TEXTURE_TRANSMISSION] = {};
    }

    const GltfFile& file_;
    const tinygltf::Material& source_;
    std::string where_;
};

}  // namespace

std::vector<Material> read_materials(const GltfFile& file, Ignored& ignored) {
    std::vector<Material> materials;
    for (std::size_t i = 0; i < file.model.materials.size(); ++i) {
        const int index = static_cast<int>(i);
        materials.push_back(MaterialReader(file, index).read());
        read_medium(file, index, materials.back(), ignored);
    }
    materials.push_back({.name = "default"});
    return materials;
}

}  // namespace wavepath
