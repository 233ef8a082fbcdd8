// Rays, and the tree that they are traced through.
#pragma once

#include "sampling/vector.cl"
#include "shared/bvh.h"
#include "shared/inline.h"
#include "shared/path.h"

typedef struct {
    Vec3 origin;
    Vec3 direction;
    float t_max;  // where it ends, in lengths of the direction
} Ray;

typedef struct {
    global const BvhNode* nodes;
    global const TriangleBlock* blocks;
} Tree;

INLINE Ray make_ray(const Vec3 origin, const Vec3 direction, const float t_max) {
    Ray ray;
    ray.origin = origin;
    ray.direction = direction;
    ray.t_max = t_max;
    return ray;
}

INLINE Tree make_tree(global const BvhNode* nodes, global const TriangleBlock* blocks) {
    Tree tree;
    tree.nodes = nodes;
    tree.blocks = blocks;
    return tree;
}

// The slot's ray, without an end.
INLINE Ray load_ray(global const float* rays, const size_t stride, const size_t slot) {
    return make_ray(
        load3(PLANE(rays, RAY_ORIGIN_X), stride, slot),
        load3(PLANE(rays, RAY_DIRECTION_X), stride, slot), INFINITY);
}

// The slot's connection to a light.
INLINE Ray load_shadow_ray(
    global const float* shadows, const size_t stride, const size_t slot, const float t_max) {
    return make_ray(
        load3(PLANE(shadows, SHADOW_ORIGIN_X), stride, slot),
        load3(PLANE(shadows, SHADOW_DIRECTION_X), stride, slot), t_max);
}

// 1/d with |d| raised to 1e-18: an axis-parallel ray gets finite slabs, not 0 * infinity = NaN.
INLINE float safe_reciprocal(const float d) {
    return 1.0f / (fabs(d) < 1e-18f ? copysign(1e-18f, d) : d);
}

// t_max, or -1, before which nothing lies, for a ray that means nothing: no length, no direction, a
// number that is none or so large that slabs would overflow. With it no comparison meets a NaN.
INLINE float end_of_ray(const Ray* ray) {
    const float away = fabs(ray->origin.x) + fabs(ray->origin.y) + fabs(ray->origin.z);
    const float length = fabs(ray->direction.x) + fabs(ray->direction.y) + fabs(ray->direction.z);
    return ray->t_max > 0.0f && away < 1e18f && length > 1e-18f && length < 1e18f ? ray->t_max
                                                                                  : -1.0f;
}
