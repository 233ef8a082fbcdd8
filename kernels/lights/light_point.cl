// Where the light is that a path would be connected to, before it is known from where: equiangular
// distances are drawn about it (media/homogeneous.cl), and direct_light, drawing the same numbers,
// chooses the same light, and the same point of it where that is sampled by area.
#pragma once

#include "geometry/interaction.cl"
#include "lights/light_choice.cl"
#include "sampling/dimensions.cl"
#include "sampling/warp.cl"
#include "shared/inline.h"
#include "shared/params.h"

typedef struct {
    Vec3 p;      // [normalised]
    int exists;  // 0: the light chosen is infinitely far away
} LightPoint;

INLINE LightPoint light_point(
    global const float* triangles,
    global const DeviceLight* lights,
    const RenderParams* params,
    const uint seed,
    const uint index,
    const uint branch,
    const uint scattering) {
    const Bits2 choice = scattering_pair(seed, index, branch, scattering, PAIR_CHOICE);
    const Bits2 point = scattering_pair(seed, index, branch, scattering, PAIR_LIGHT_POINT);
    global const DeviceLight* light =
        lights + (int)choose_light(lights, params->light_count, choice.u);
    const int is_triangle = light->kind == LIGHT_TRIANGLE;
    global const float* triangle =
        triangles + TRIANGLE_FLOATS * (is_triangle ? (int)light->primitive : 0);
    const Sample2 b = sample_triangle(unit_pair(point));
    LightPoint r;
    r.p = select3(
        is_triangle, interpolate(triangle, TRIANGLE_CORNERS, b.u, b.v),
        vec3(light->position_x, light->position_y, light->position_z));
    r.exists = is_triangle | (light->kind == LIGHT_POINT);
    return r;
}
