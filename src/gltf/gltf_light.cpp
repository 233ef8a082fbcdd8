#include "gltf/gltf_nodes.h"
#include "scene/transform.h"

#include <limits>
#include <numbers>

namespace wavepath {
namespace {

constexpr const char* extension_name = "KHR_lights_punctual";

LightKind light_kind(const GltfFile& file, std::string_view where, const std::string& type) {
    if (type == "point") return LightKind::point;
    if (type == "spot") return LightKind::spot;
    if (type == "directional") return LightKind::directional;
    file.fail(where, "type \"{}\" is unknown; use point, spot or directional", one_line(type));
}

Rgb light_intensity(const GltfFile& file, std::string_view where, const tinygltf::Light& source) {
    const std::vector<double> color =
        source.color.empty() ? std::vector<double>{1, 1, 1} : source.color;
    if (color.size() != 3)
        file.fail(where, "color has {} numbers instead of 3; repair it", color.size());
    Rgb intensity;
    for (std::size_t i = 0; i < 3; ++i) {
        const double value = color[i] * source.intensity;
        if (!(color[i] >= 0 && source.intensity >= 0 && value <= std::numeric_limits<float>::max()))
            file.fail(
                where, "color {} times intensity {} is no intensity; repair them", color[i],
                source.intensity);
        intensity[i] = static_cast<float>(value);
    }
    return intensity;
}

void read_cone(
    const GltfFile& file,
    std::string_view where,
    const tinygltf::SpotLight& source,
    PunctualLight& light) {
    light.inner_cone = source.innerConeAngle;
    light.outer_cone = source.outerConeAngle;
    constexpr double right_angle = std::numbers::pi / 2 + 1e-6;  // may have been rounded to float
    if (!(light.inner_cone >= 0 && light.inner_cone <= light.outer_cone && light.outer_cone > 0 &&
          light.outer_cone <= right_angle))
        file.fail(
            where, "cone angles {} and {} rad are not 0 <= inner <= outer <= pi/2; repair them",
            light.inner_cone, light.outer_cone);
}

}  // namespace

std::optional<PunctualLight> read_light(const GltfFile& file, const PlacedNode& placed) {
    const auto* reference = find_extension(placed.node.extensions, extension_name);
    if (!reference) return std::nullopt;
    const int index = reference->Get("light").Get<int>();
    const tinygltf::Light& source = file.at(file.model.lights, index, "light", placed.label);
    const std::string where = label("light", index, source.name);

    PunctualLight light;
    light.name = source.name.empty() ? placed.node.name : source.name;
    light.kind = light_kind(file, where, source.type);
    light.intensity = light_intensity(file, where, source);
    light.position = axis(placed.to_world, 3);
    light.range = source.range;
    if (!(light.range >= 0))
        file.fail(where, "range is {}, not positive; repair or remove it", light.range);
    if (light.kind == LightKind::spot) read_cone(file, where, source.spot, light);
    if (light.kind == LightKind::point) return light;

    const Vec3d backward = normalized(axis(placed.to_world, 2));
    if (backward == Vec3d{0, 0, 0})
        file.fail(
            placed.label, "its scale leaves the light no direction; give it a scale other than 0");
    light.direction = {-backward[0], -backward[1], -backward[2]};
    return light;
}

}  // namespace wavepath
