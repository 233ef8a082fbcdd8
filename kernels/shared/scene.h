// The scene as kernels see it: normalised (centre at the origin, extent 1).
#ifndef WAVEPATH_SCENE_H
#define WAVEPATH_SCENE_H

#include "shared/cl_types.h"

// Colours stand channel by channel: neighbouring r, g, b would be loaded as a vector by LLVM's SLP
// pass, and a kernel that holds a vector of its own is not vectorised across work-items by PoCL.
typedef struct {
    shared_float base_r;      // [1] baseColorFactor
    shared_float f0_r;        // [1] dielectric reflectance at normal incidence
    shared_float emission_r;  // radiance
    shared_float metallic;    // [1]
    shared_float base_g;
    shared_float f0_g;
    shared_float emission_g;
    shared_float specular;  // [1] weight of the dielectric's specular layer
    shared_float base_b;
    shared_float f0_b;
    shared_float emission_b;
    shared_float alpha;         // [1] roughness^2
    shared_uint double_sided;   // emits from both faces
    shared_uint boundary;       // BOUNDARY_*
    shared_uint medium;         // row of the table of media + 1 of what it encloses; 0: nothing
    shared_float transmission;  // [1] share of what enters that goes through: straight (thin
                                // walls), or into the medium
} DeviceMaterial;
SHARED_SIZE(DeviceMaterial, 64);

// What a material does to light that meets it.
#define BOUNDARY_OPAQUE 0u
#define BOUNDARY_DIELECTRIC 1u     // reflects and refracts by Fresnel's equations
#define BOUNDARY_INDEX_MATCHED 2u  // and above: passes straight, tinted by the base colour
#define BOUNDARY_CLEAR 3u          // index-matched without a tint

// A homogeneous medium; lengths are those of the normalised scene.
typedef struct {
    shared_float sigma_t_r;   // extinction per length
    shared_float sigma_s_r;   // scattering per length
    shared_float emission_r;  // radiance emitted per length
    shared_float anisotropy;  // [1] g: mean cosine of the phase function
    shared_float sigma_t_g;
    shared_float sigma_s_g;
    shared_float emission_g;
    shared_float ior;  // [1] refractive index; 0, within an index-matched boundary: that around it
    shared_float sigma_t_b;
    shared_float sigma_s_b;
    shared_float emission_b;
    shared_float padding;
} DeviceMedium;
SHARED_SIZE(DeviceMedium, 48);

// A triangle is TRIANGLE_FLOATS floats in scene order: these, then what the scene's vertices have
// (geometry/attributes.cl).
#define TRIANGLE_MATERIAL 0    // (uint bits)
#define TRIANGLE_LIGHT 1       // (uint bits) row of the light table, NO_LIGHT or AT_LAMP
#define TRIANGLE_CORNERS 2     // 3 x (x, y, z)
#define TRIANGLE_BITANGENT 11  // bitangent = this (1 or -1) * cross(normal, tangent)
#define TRIANGLE_ATTRIBUTES 12
#define NO_LIGHT 0xFFFFFFFFu
#define AT_LAMP 0xFFFFFFFEu  // no light, but one touches it

// Kinds of a DeviceLight.
#define LIGHT_TRIANGLE 0u
#define LIGHT_ENVIRONMENT 1u
#define LIGHT_POINT 2u  // and spot: a point whose cone is everything
#define LIGHT_DIRECTIONAL 3u

// One entry of the light table with its row of the alias table (Walker 1974, Vose 1991).
typedef struct {
    shared_float alias_threshold;  // [1] below: this light, else `alias`
    shared_uint alias;
    shared_float pmf;  // [1] probability to be chosen
    shared_uint kind;
    shared_uint primitive;    // LIGHT_TRIANGLE: its triangle
    shared_float area;        // LIGHT_TRIANGLE: [normalised^2]
    shared_float range;       // LIGHT_POINT: [normalised] 0: unlimited
    shared_float spot_outer;  // LIGHT_POINT: falloff = saturate((outer - (1 - cos)) * scale)^2
    shared_float spot_scale;
    shared_uint double_sided;  // LIGHT_TRIANGLE: emits from both faces
    shared_float intensity_r;  // LIGHT_TRIANGLE: radiance; LIGHT_POINT: [W/sr] in units of the
                               // normalised scene; LIGHT_DIRECTIONAL: [W/m^2]
    shared_float position_x;   // [normalised]
    shared_float direction_x;  // the way it shines, unit
    shared_float intensity_g;
    shared_float position_y;
    shared_float direction_y;
    shared_float intensity_b;
    shared_float position_z;
    shared_float direction_z;
    shared_uint padding2;
} DeviceLight;
SHARED_SIZE(DeviceLight, 80);

// Environment map. Between the centres of its texels lie height + 1 rows of `width` cells; the
// first and the last row, at the poles, are half as high. One entry a row of cells (its chance to
// be chosen), then one a cell (its chance within the row), row by row; it holds the texel that is
// the cell's corner towards lower u and higher v.
typedef struct {
    shared_float alias_threshold;
    shared_uint alias;
    shared_float pmf;      // [1]
    shared_float r, g, b;  // radiance
} EnvironmentEntry;
SHARED_SIZE(EnvironmentEntry, 24);

#endif
