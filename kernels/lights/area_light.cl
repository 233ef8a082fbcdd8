// Emissive triangles, sampled uniformly by area (notes 5: sourceArea * visible * G *
// emittedRadiance) or by solid angle.
#pragma once

#include "geometry/interaction.cl"
#include "lights/light_choice.cl"
#include "lights/solid_angle.cl"
#include "sampling/mis.cl"
#include "shared/inline.h"

typedef struct {
    Vec3 p;         // end of the connection; for lights at infinity far outside the scene
    Vec3 wi;        // towards it, unit
    Vec3 radiance;  // divided by the density: L_e / pdf_w, or intensity terms of a punctual light
    float pdf_w;    // [1/sr] of the point, light choice included; PDF_CERTAIN: a bsdf sample cannot
                    // find this light
    Sample2 at;     // barycentric weights of corners 1 and 2 of an area light
} LightSample;

// pdf_w [1/sr], light choice included, with which the point of the triangle at squared distance
// `distance2` from `from`, seen there under cosine `cos_light`, is chosen.
INLINE float area_light_pdf_w(
    global const float* triangle,
    global const DeviceLight* light,
    const Vec3 from,
    const float distance2,
    const float cos_light) {
    const float by_area = pdf_a_to_w(light->pmf / light->area, distance2, cos_light);
    if (!LIGHTS_BY_SOLID_ANGLE) return by_area;
    const SeenTriangle seen = see_triangle(triangle, from);
    return is_seen_well(seen) ? light->pmf / seen.solid_angle : by_area;
}

INLINE LightSample area_light_sample(
    global const float* triangles,
    global const DeviceLight* light,
    const Vec3 from,
    const Sample2 u) {
    const int primitive = light->kind == LIGHT_TRIANGLE ? (int)light->primitive : 0;
    global const float* triangle = triangles + TRIANGLE_FLOATS * primitive;
    LightSample s;
    s.at = sample_triangle(u);
    if (LIGHTS_BY_SOLID_ANGLE) {
        const SeenTriangle seen = see_triangle(triangle, from);
        const Sample2 at = sample_seen_triangle(seen, u);
        const int by_solid_angle = is_seen_well(seen);
        s.at.u = by_solid_angle ? at.u : s.at.u;
        s.at.v = by_solid_angle ? at.v : s.at.v;
    }
    const Vec3 face = scale3(triangle_cross(triangle), 0.5f / light->area);
    const Vec3 point = interpolate(triangle, TRIANGLE_CORNERS, s.at.u, s.at.v);
    const Vec3 to_light = sub3(point, from);
    const float distance2 = dot3(to_light, to_light);

    s.wi = scale3(to_light, 1.0f / sqrt(distance2));
    const float cos_front = -dot3(s.wi, face);
    const float cos_light = fabs(cos_front);
    const int lit = (light->double_sided ? cos_light : cos_front) > 0.0f;
    s.pdf_w = area_light_pdf_w(triangle, light, from, distance2, cos_light);
    // The connection ends just before the light, on the side it is seen from, and as far before it
    // as rounding at its start may carry it.
    const float offset = max(ray_offset(point), ray_offset(from));
    s.p = madd3(point, scale3(face, cos_front > 0.0f ? 1.0f : -1.0f), offset);
    s.radiance = scale3(
        vec3(light->intensity_r, light->intensity_g, light->intensity_b),
        lit ? 1.0f / s.pdf_w : 0.0f);
    return s;
}
