// Which of the opaque faces that touch one another is seen. Connections to a lamp end ray_offset
// before it (lights/area_light.cl), so that nothing closer hides it; what rays meet has to follow.
#pragma once

#include "geometry/bvh.cl"
#include "media/medium_stack.cl"

// Of the faces that lie within ray_offset behind `first`, the closest on a ray of this direction
// and length, that one which emits towards the ray, the lowest id of several, else `first` itself.
INLINE Hit shown_face(
    global const BvhNode* nodes,
    global const TriangleBlock* blocks,
    const Cover* cover,
    global const DeviceMaterial* materials,
    const Vec3 origin,
    const Vec3 direction,
    const float length,
    const Hit first) {
    global const float* triangles = cover->triangles;
    global const float* triangle = triangles + (size_t)TRIANGLE_FLOATS * first.primitive;
    const Vec3 unit = scale3(direction, 1.0f / length);
    const float end =
        first.t + touching_distance(triangle, madd3(origin, direction, first.t), unit) / length;
    Hit shown = first;
    int emits = emits_towards(triangle, materials, direction);
    RayStart start = ray_start(first.t, first.primitive);
    while (LAMPS_ON_LAMPS || !emits) {
        const Hit hit = closest_hit(
            nodes, blocks, origin.x, origin.y, origin.z, direction.x, direction.y, direction.z, end,
            start, holes_in(cover));
        if (hit.primitive < 0) break;
        start = ray_start(hit.t, hit.primitive);
        triangle = triangles + (size_t)TRIANGLE_FLOATS * hit.primitive;
        const int wins = emits_towards(triangle, materials, direction) &
                         (!emits | (hit.primitive < shown.primitive));
        if (!wins) continue;
        shown = hit;
        emits = 1;
    }
    return shown;
}
