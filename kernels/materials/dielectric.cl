// The interface of two dielectrics, smooth or of microfacets with the GGX distribution [Walter
// 2007]. Directions are in the shading frame, leaving the surface, wo.z > 0 on the side of index
// ior_i; wi.z < 0 lies on the other side, of index ior_t.
#pragma once

#include "geometry/shading_normal.cl"
#include "materials/ggx.cl"
#include "sampling/vector.cl"
#include "shared/features.h"
#include "shared/inline.h"
#include "shared/path.h"

typedef struct {
    float reflectance;  // [1] unpolarised mean
    float cosine;       // of the refracted ray; 0 at total reflection
} Interface;

// Fresnel's equations for a ray that arrives under `cosine` > 0 from index ior_i, towards ior_t.
INLINE Interface fresnel_interface(const float cosine, const float ior_i, const float ior_t) {
    const float eta = ior_i / ior_t;
    const float sine2 = eta * eta * fma(-cosine, cosine, 1.0f);
    const float beyond = sqrt(max(0.0f, 1.0f - sine2));
    const float s = (ior_i * cosine - ior_t * beyond) / fma(ior_i, cosine, ior_t * beyond);
    const float p = (ior_t * cosine - ior_i * beyond) / fma(ior_t, cosine, ior_i * beyond);
    Interface r;
    r.reflectance = sine2 >= 1.0f ? 1.0f : 0.5f * fma(s, s, p * p);
    r.cosine = beyond;
    return r;
}

// The first so many scatterings of a path reflect totally by the vertex normal, the next so many by
// the face's own, and so in turn. Either alone may send light round for ever, vertex normals in a
// ball as in a whispering gallery, faces in a cube; what is steady for one is not for the other.
// The eye follows no light so far. A power of two.
#define TOTAL_REFLECTIONS_BY_ONE 16u

INLINE int is_reflected_totally(const float cosine, const float ior_i, const float ior_t) {
    const float eta = ior_i / ior_t;
    return eta * eta * fma(-cosine, cosine, 1.0f) >= 1.0f;
}

// The normal of the interface where the shading normal `n` and the face's `ng` differ; `wo`: unit,
// towards the viewer, seen from the front of both, in the world. Vertex normals alone would trap
// what has entered a clear body: on a chord of a ball they are those of a point further out, and
// reflect totally what the ball itself would let go. So total reflection needs both; what leaves
// against the vertex normal leaves by the face.
INLINE Vec3 interface_normal(
    const Vec3 n,
    const Vec3 ng,
    const Vec3 wo,
    const float ior_i,
    const float ior_t,
    const uint scatterings) {
    const int by_n = is_reflected_totally(dot3(n, wo), ior_i, ior_t);
    const int by_face = is_reflected_totally(dot3(ng, wo), ior_i, ior_t);
    const int turn_of_face = (scatterings & TOTAL_REFLECTIONS_BY_ONE) != 0u;
    return select3(by_n & (!by_face | turn_of_face), ng, n);
}

// Equal indices refract nothing, whatever the roughness.
INLINE int dielectric_is_rough(const float alpha, const float ior_i, const float ior_t) {
    return alpha >= MIRROR_ALPHA && ior_i != ior_t;
}

// What masking leaves of wi where wo is visible: G2 / G1(wo), height-correlated on one side [Heitz
// 2014, eq. 99], separable across [Walter 2007, eq. 23].
INLINE float ggx_shadowing(const Vec3 wo, const Vec3 wi, const float alpha) {
    const float c = fabs(wi.z);
    const float root_i = ggx_smith_root(c, alpha);
    const float root_o = ggx_smith_root(wo.z, alpha);
    const float same_side = c * (wo.z + root_o) / fma(c, root_o, wo.z * root_i);
    return wi.z > 0.0f ? same_side : 2.0f * c / (c + root_i);
}

typedef struct {
    float value;  // f cos, for radiance: a refracted ray carries (ior_i / ior_t)^2 of it
    float pdf_w;  // [1/sr] of dielectric_sample
} DielectricValue;

// Of a rough interface.
INLINE DielectricValue dielectric_eval(
    const Vec3 wo, const Vec3 wi, const float alpha, const float ior_i, const float ior_t) {
    const int reflects = wi.z > 0.0f;
    const Vec3 across = madd3(scale3(wo, ior_i), wi, ior_t);
    const Vec3 h = normalize3(select3(reflects, add3(wo, wi), across));
    const Vec3 m = scale3(h, h.z < 0.0f ? -1.0f : 1.0f);
    const float cos_o = dot3(wo, m);
    const float cos_i = dot3(wi, m);
    const float reflectance = fresnel_interface(clamp(cos_o, 0.0f, 1.0f), ior_i, ior_t).reflectance;
    // from visible facets to directions: 1 / (4 wo.m), and Walter 2007, eq. 17
    const float mirrored = ggx_pdf_w(wo, m, alpha);
    const float denominator = fma(ior_i, cos_o, ior_t * cos_i);
    const float refracted =
        4.0f * cos_o * mirrored * ior_t * ior_t * fabs(cos_i) / (denominator * denominator);
    // facets that either direction sees from behind send nothing there
    const int faces = (cos_o > 0.0f) & (reflects ? cos_i > 0.0f : cos_i < 0.0f);
    const float pdf_w = reflects ? reflectance * mirrored : (1.0f - reflectance) * refracted;
    const float eta = ior_i / ior_t;
    DielectricValue r;
    r.pdf_w = faces ? pdf_w : 0.0f;
    r.value = r.pdf_w * ggx_shadowing(wo, wi, alpha) * (reflects ? 1.0f : eta * eta);
    return r;
}

// Of a rough interface whose lobes lie around the normal of `frame`, on a face of normal `ng`: what
// a lobe sends to the wrong side of the face is mirrored at it (geometry/shading_normal.cl).
// `wi`: in the world.
INLINE DielectricValue dielectric_towards(
    const Frame frame,
    const Vec3 ng,
    const Vec3 wo,
    const Vec3 wi,
    const float alpha,
    const float ior_i,
    const float ior_t) {
    const Vec3 direct = to_local(frame, wi);
    DielectricValue r = dielectric_eval(wo, direct, alpha, ior_i, ior_t);
    if (!HAS_SHADING_NORMALS) return r;
    const int above = dot3(ng, wi) > 0.0f;
    const Vec3 mirrored = to_local(frame, mirror3(wi, ng));
    const DielectricValue m = dielectric_eval(wo, mirrored, alpha, ior_i, ior_t);
    const float by_direct = (direct.z > 0.0f) == above ? 1.0f : 0.0f;
    const float by_mirrored = (mirrored.z > 0.0f) == above ? 1.0f : 0.0f;
    r.value = fma(by_direct, r.value, by_mirrored * m.value);
    r.pdf_w = fma(by_direct, r.pdf_w, by_mirrored * m.pdf_w);
    return r;
}

typedef struct {
    Vec3 wi;
    int reflects;
    float weight;  // f cos / pdf_w; 0: lost between facets
    float pdf_w;   // [1/sr], or PDF_CERTAIN from a smooth interface
} DielectricSample;

// A facet visible from wo, then reflected with the chance that Fresnel's equations give.
INLINE DielectricSample dielectric_sample(
    const Vec3 wo,
    const float alpha,
    const float ior_i,
    const float ior_t,
    const Sample2 u,
    const float choice) {
    const int rough = ROUGH_DIELECTRICS && dielectric_is_rough(alpha, ior_i, ior_t);
    const float width = max(alpha, MIRROR_ALPHA);
    Vec3 m = vec3(0.0f, 0.0f, 1.0f);
    if (ROUGH_DIELECTRICS) m = select3(rough, ggx_sample(wo, width, u), m);
    const float cosine = min(dot3(wo, m), 1.0f);
    const Interface interface = fresnel_interface(cosine, ior_i, ior_t);
    const float eta = ior_i / ior_t;
    DielectricSample s;
    s.reflects = choice < interface.reflectance;
    const Vec3 reflected = sub3(scale3(m, 2.0f * cosine), wo);
    const Vec3 refracted = madd3(scale3(wo, -eta), m, fma(eta, cosine, -interface.cosine));
    s.wi = normalize3(select3(s.reflects, reflected, refracted));
    s.weight = s.reflects ? 1.0f : eta * eta;
    s.pdf_w = PDF_CERTAIN;
    if (ROUGH_DIELECTRICS) {
        s.weight *= rough ? ggx_shadowing(wo, s.wi, width) : 1.0f;
        s.pdf_w = rough ? dielectric_eval(wo, s.wi, width, ior_i, ior_t).pdf_w : s.pdf_w;
    }
    s.weight = s.wi.z * (s.reflects ? 1.0f : -1.0f) <= 0.0f ? 0.0f : s.weight;
    return s;
}
