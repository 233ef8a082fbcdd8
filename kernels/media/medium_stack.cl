// Which medium surrounds a path: plane MEDIUM_STACK, eight bits a medium (its row + 1), the one
// entered last lowest. That one fills the space, whatever lies around it: the innermost entered
// wins.
#pragma once

#include "geometry/interaction.cl"
#include "shared/film.h"
#include "shared/inline.h"

INLINE uint innermost_medium(const uint stack) {
    return stack & 255u;
}

INLINE uint enter_medium(const uint stack, const uint medium) {
    return stack << 8 | medium;
}

// Takes the uppermost entry of this medium away; a stack without one stays as it is: the mesh is
// not closed.
INLINE uint leave_medium(const uint stack, const uint medium) {
    const uint above = (stack & 255u) == medium         ? 0u
                       : (stack >> 8 & 255u) == medium  ? 0xFFu
                       : (stack >> 16 & 255u) == medium ? 0xFFFFu
                       : (stack >> 24) == medium        ? 0xFFFFFFu
                                                        : 0xFFFFFFFFu;
    const uint without = (stack & above) | (stack >> 8 & ~above);
    return above == 0xFFFFFFFFu ? stack : without;
}

// The stack behind a boundary that a ray of this direction passes. A fifth medium does not fit:
// weight_of_crossing.
INLINE uint cross_boundary(
    const uint stack, const uint medium, global const float* triangle, const Vec3 direction) {
    const int enters = dot3(triangle_cross(triangle), direction) < 0.0f;
    return enters ? enter_medium(stack, medium) : leave_medium(stack, medium);
}

// How far along a ray surfaces behind this triangle, met at p, still touch it: ray_offset along its
// normal. A grazing ray may leave a curved surface before that.
#define LEAST_COSINE 0x1p-8f
INLINE float touching_distance(global const float* triangle, const Vec3 p, const Vec3 direction) {
    const float cosine = fabs(dot3(normalize3(triangle_cross(triangle)), direction));
    return ray_offset(p) / max(cosine, LEAST_COSINE);
}

// The ray goes on behind the boundary of this triangle, met at t, from these media into those.
INLINE void go_on_behind(
    global float* path_media,
    const size_t stride,
    const size_t slot,
    const uint stack,
    const uint crossed,
    const float t,
    const int primitive,
    const float touching) {
    const int alone = as_int(PLANE(path_media, MEDIUM_PRIMITIVE)[slot]) == NO_BOUNDARY ||
                      t - PLANE(path_media, MEDIUM_T)[slot] > touching;
    if (alone) PLANE(path_media, MEDIUM_BEFORE)[slot] = as_float(stack);
    PLANE(path_media, MEDIUM_STACK)[slot] = as_float(crossed);
    PLANE(path_media, MEDIUM_T)[slot] = t;
    PLANE(path_media, MEDIUM_PRIMITIVE)[slot] = as_float(primitive);
    PLANE(path_media, MEDIUM_TOUCHING)[slot] = touching;
    PLANE(path_media, MEDIUM_PASSES)
    [slot] = as_float(as_uint(PLANE(path_media, MEDIUM_PASSES)[slot]) + 1);
}

// Of the innermost medium that has one of its own: what is within an index-matched boundary has
// that of its surroundings.
INLINE float refractive_index(global const DeviceMedium* media, const uint stack) {
    if (!HAS_MATCHED_MEDIA) {
        const uint innermost = innermost_medium(stack);
        const float ior = media[(int)max(innermost, 1u) - 1].ior;
        return innermost > 0 ? ior : 1.0f;
    }
    float index = 1.0f;
    for (uint shift = 32; shift > 0; shift -= 8) {
        const uint row = stack >> (shift - 8) & 255u;
        const float ior = media[(int)max(row, 1u) - 1].ior;
        index = ((row > 0) & (ior > 0.0f)) ? ior : index;
    }
    return index;
}

// 1; NaN where more media lie around one another than the stack holds, to be found and counted. Its
// payload, which arithmetic keeps [IEEE 754-2019, section 6.2.3], tells the host the reason.
INLINE float weight_of_crossing(const uint stack, const uint crossed, const uint medium) {
    const int overflows = (stack >> 24 != 0u) & (crossed == enter_medium(stack, medium));
    return overflows ? as_float(NAN_OF_MEDIA) : 1.0f;
}

// A ray that starts at its own origin, not behind a boundary.
INLINE void start_at_origin(global float* path_media, const size_t stride, const size_t slot) {
    PLANE(path_media, MEDIUM_T)[slot] = 0.0f;
    PLANE(path_media, MEDIUM_PRIMITIVE)[slot] = as_float(NO_BOUNDARY);
    PLANE(path_media, MEDIUM_TOUCHING)[slot] = 0.0f;
    PLANE(path_media, MEDIUM_PASSES)[slot] = as_float(0);
}
