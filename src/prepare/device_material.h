#pragma once

#include "scene/scene.h"
#include "shared/scene.h"

namespace wavepath {

// F0 of the dielectric: min(((ior - 1) / (ior + 1))^2 * specularColor, 1); 1 for ior 0
// (KHR_materials_ior, _specular). Where a texture tints it, the minimum is left to apply_textures.
// `medium`: MediaTables::rows.
DeviceMaterial device_material(const Material& material, uint32_t medium);

// What is left of a boundary that transmits in part: an opaque surface, which stands as many rows
// behind it as there are materials (kernels/media/boundary_share.cl).
DeviceMaterial opaque_rest(const DeviceMaterial& boundary);

// Whether a boundary takes from what passes: by a base colour, or since it transmits in part.
bool has_tint(const Material& material);

// Whether it is a boundary of microfacets that refract.
bool refracts_roughly(const Material& material);

// Whether it is a thin wall that may, at some point, be smooth: light goes straight through it.
bool may_pass_straight(const Material& material);

// Whether it has a lobe besides the Lambertian, or numbers that are looked up like those of lobes.
bool has_lobes(const Material& material);

// Whether it is a dielectric, in part at least, whose specular layer has something below.
bool has_layer(const Material& material);

}  // namespace wavepath
