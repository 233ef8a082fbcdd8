// A triangle's record (shared/scene.h): its corners and what is interpolated between them.
#pragma once

#include "sampling/vector.cl"
#include "shared/features.h"
#include "shared/inline.h"
#include "shared/scene.h"

// Behind the corners, each where the scene has it: normals, colours, texture coordinates (6 a set),
// tangents, alphas.
#define TRIANGLE_NORMALS TRIANGLE_ATTRIBUTES
#define TRIANGLE_COLORS (TRIANGLE_NORMALS + 9 * HAS_VERTEX_NORMALS)
#define TRIANGLE_UVS (TRIANGLE_COLORS + 9 * HAS_VERTEX_COLORS)
#define TRIANGLE_TANGENTS (TRIANGLE_UVS + 6 * UV_SETS)
#define TRIANGLE_ALPHAS (TRIANGLE_TANGENTS + 9 * HAS_NORMAL_MAPS)
#define TRIANGLE_FLOATS (TRIANGLE_ALPHAS + 3 * HAS_VERTEX_ALPHAS)

INLINE Vec3 triangle_corner(global const float* triangle, const int attribute, const int corner) {
    return vec3(
        triangle[attribute + 3 * corner], triangle[attribute + 3 * corner + 1],
        triangle[attribute + 3 * corner + 2]);
}

INLINE Vec3
interpolate(global const float* triangle, const int attribute, const float u, const float v) {
    const Vec3 a = triangle_corner(triangle, attribute, 0);
    const Vec3 b = triangle_corner(triangle, attribute, 1);
    const Vec3 c = triangle_corner(triangle, attribute, 2);
    return madd3(madd3(scale3(a, 1.0f - u - v), b, u), c, v);
}

// Of a number that stands `step` floats apart at the three corners.
INLINE float interpolate_float(
    global const float* triangle,
    const int attribute,
    const int step,
    const float u,
    const float v) {
    const float a = triangle[attribute] * (1.0f - u - v);
    return fma(triangle[attribute + 2 * step], v, fma(triangle[attribute + step], u, a));
}

// Normal of a triangle, not unit: length = twice the area; towards whom its corners run
// counter-clockwise.
INLINE Vec3 triangle_cross(global const float* triangle) {
    const Vec3 a = triangle_corner(triangle, TRIANGLE_CORNERS, 0);
    return cross3(
        sub3(triangle_corner(triangle, TRIANGLE_CORNERS, 1), a),
        sub3(triangle_corner(triangle, TRIANGLE_CORNERS, 2), a));
}
