#pragma once

#include "scene/scene.h"
#include "shared/scene.h"

namespace wavepath {

// F0 of the dielectric: min(((ior - 1) / (ior + 1))^2 * specularColor, 1); 1 for ior 0
// (KHR_materials_ior, _specular). Where a texture tints it, the minimum is left to apply_textures.
// `medium`: MediaTables::rows.
DeviceMaterial device_material(const Material& material, uint32_t medium);

// Whether its base colour is not white everywhere.
bool has_tint(const Material& material);

// Whether it is a boundary of microfacets that refract.
bool refracts_roughly(const Material& material);

// Whether it is a thin wall that may, at some point, be smooth: light goes straight through it.
bool may_pass_straight(const Material& material);

// Whether it has a lobe besides the Lambertian.
bool reflects_specularly(const Material& material);

// Whether it is a dielectric, in part at least, whose specular layer has something below.
bool has_layer(const Material& material);

}  // namespace wavepath
