// Which of the opaque faces that touch one another is seen. Connections to a lamp end ray_offset
// before it (lights/area_light.cl), so that nothing closer hides it; what rays meet has to follow.
#pragma once

#include "geometry/bvh.cl"
#include "media/medium_stack.cl"

// Of the faces that lie within ray_offset behind `first`, the closest on a ray whose direction has
// this length, that one which emits towards the ray, the lowest id of several, else `first` itself.
INLINE Hit shown_face(
    const Tree tree,
    const Cover* cover,
    global const DeviceMaterial* materials,
    Ray ray,
    const float length,
    const Hit first) {
    global const float* triangles = cover->triangles;
    global const float* triangle = triangles + (size_t)TRIANGLE_FLOATS * first.primitive;
    const Vec3 unit = scale3(ray.direction, 1.0f / length);
    const Vec3 met = madd3(ray.origin, ray.direction, first.t);
    ray.t_max = first.t + touching_distance(triangle, met, unit) / length;
    Hit shown = first;
    int emits = emits_towards(triangle, materials, ray.direction);
    RayStart start = ray_start(first.t, first.primitive);
    while (LAMPS_ON_LAMPS || !emits) {
        const Hit hit = closest_hit(tree, &ray, start, holes_in(cover));
        if (hit.primitive < 0) break;
        start = ray_start(hit.t, hit.primitive);
        triangle = triangles + (size_t)TRIANGLE_FLOATS * hit.primitive;
        const int wins = emits_towards(triangle, materials, ray.direction) &
                         (!emits | (hit.primitive < shown.primitive));
        if (!wins) continue;
        shown = hit;
        emits = 1;
    }
    return shown;
}
