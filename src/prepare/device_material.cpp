#include "prepare/device_material.h"

#include <algorithm>

namespace wavepath {

namespace {

constexpr float mirror_alpha = 1e-3F;  // kernels/materials/ggx.cl, MIRROR_ALPHA

float dielectric_f0(const Material& material, std::size_t channel) {
    if (material.ior == 0) return 1;
    const float ratio = (material.ior - 1) / (material.ior + 1);
    const float f0 = ratio * ratio * material.specular_color[channel];
    return material.has(TEXTURE_SPECULAR_COLOR) ? f0 : std::min(f0, 1.0F);
}

uint32_t device_boundary(const Material& material) {
    switch (material.boundary) {
        case Boundary::opaque:
            return BOUNDARY_OPAQUE;
        case Boundary::index_matched:
            return has_tint(material) ? BOUNDARY_INDEX_MATCHED : BOUNDARY_CLEAR;
        case Boundary::dielectric:
            return BOUNDARY_DIELECTRIC;
    }
    return BOUNDARY_OPAQUE;
}

}  // namespace

bool has_tint(const Material& material) {
    return material.base_color != Rgb{1, 1, 1} || material.has(TEXTURE_BASE_COLOR) ||
           material.transmits_in_part();
}

DeviceMaterial device_material(const Material& material, uint32_t medium) {
    DeviceMaterial d{};
    d.base_r = material.base_color[0];
    d.base_g = material.base_color[1];
    d.base_b = material.base_color[2];
    d.metallic = material.metallic;
    d.f0_r = dielectric_f0(material, 0);
    d.f0_g = dielectric_f0(material, 1);
    d.f0_b = dielectric_f0(material, 2);
    d.specular = material.specular;
    d.emission_r = material.emission[0];
    d.emission_g = material.emission[1];
    d.emission_b = material.emission[2];
    d.alpha = material.roughness * material.roughness;
    d.transmission = material.transmission;
    d.double_sided = material.double_sided ? 1 : 0;
    d.boundary = device_boundary(material);
    d.medium = medium;
    return d;
}

DeviceMaterial opaque_rest(const DeviceMaterial& boundary) {
    DeviceMaterial rest = boundary;
    const float share = boundary.transmission * (1 - boundary.metallic);
    rest.metallic = share < 1 ? boundary.metallic / (1 - share) : 0;
    rest.transmission = 0;
    rest.boundary = BOUNDARY_OPAQUE;
    rest.medium = 0;
    return rest;
}

bool refracts_roughly(const Material& material) {
    return material.boundary == Boundary::dielectric &&
           material.roughness * material.roughness >= mirror_alpha;
}

bool may_pass_straight(const Material& material) {
    const bool is_smooth = material.roughness * material.roughness < mirror_alpha ||
                           material.has(TEXTURE_METALLIC_ROUGHNESS);
    return material.boundary == Boundary::opaque && material.transmission > 0 &&
           !material.is_metal() && is_smooth;
}

bool has_lobes(const Material& material) {
    if (material.boundary == Boundary::opaque)
        return material.metallic > 0 || material.specular > 0 || material.transmission > 0;
    const bool refracts = material.boundary == Boundary::dielectric;
    return material.transmits_in_part() || (refracts && material.has(TEXTURE_METALLIC_ROUGHNESS));
}

bool has_layer(const Material& material) {
    const bool reflects = material.boundary == Boundary::opaque || material.transmits_in_part();
    return reflects && !material.is_metal() && (material.specular > 0 || material.transmission > 0);
}

}  // namespace wavepath
