// glTF 2.0 metallic-roughness (appendix B) with KHR_materials_ior and KHR_materials_specular:
//   f_r = D V [(1 - metallic) specular F + metallic F_metal] + (1 - metallic) (1 - specular max F)
//   (1 - transmission) base / pi
// and, to the other side of a thin wall (KHR_materials_transmission), with wi mirrored in D V and
// F,
//   f_t = D V (1 - metallic) (1 - specular max F) transmission base
// The dielectric's layering gains energy at grazing angles by specification (the appendix says so
// itself). Directions are in the shading frame, leaving the surface, with wo.z > 0; wi.z < 0 has
// gone through. Below, `through` picks f_t, for which wi is given mirrored: wi.z > 0 too.
#pragma once

#include "materials/fresnel.cl"
#include "materials/ggx.cl"
#include "materials/lambert.cl"
#include "shared/features.h"
#include "shared/inline.h"
#include "shared/path.h"

typedef struct {
    Vec3 base;           // [1]
    Vec3 f0;             // [1] of the dielectric
    float metallic;      // [1]
    float specular;      // [1] weight of the dielectric's specular layer
    float alpha;         // [1]
    float transmission;  // [1] share of what the specular layer lets in that goes through
} Surface;

typedef struct {
    Vec3 specular;  // factor of D V
    Vec3 diffuse;   // albedo of the Lambert part
    Vec3 through;   // factor of D V of the other side
} Reflectance;

// Both factors for a microfacet that sees wo under `cosine` = wo.m.
INLINE Reflectance gltf_reflectance(const Surface s, const float cosine) {
    Reflectance r;
    if (!HAS_SPECULAR) {
        r.specular = vec3(0.0f, 0.0f, 0.0f);
        r.diffuse = s.base;
        r.through = r.specular;
        return r;
    }
    const float weight = schlick_weight(cosine);
    const Vec3 dielectric = scale3(schlick(s.f0, weight), s.specular);
    const Vec3 metal = schlick(s.base, weight);
    const float dielectric_share = 1.0f - s.metallic;
    r.specular = madd3(scale3(dielectric, dielectric_share), metal, s.metallic);
    const Vec3 entered = scale3(s.base, dielectric_share * (1.0f - max_component3(dielectric)));
    r.diffuse = HAS_TRANSMISSION ? scale3(entered, 1.0f - s.transmission) : entered;
    r.through = scale3(entered, HAS_TRANSMISSION ? s.transmission : 0.0f);
    return r;
}

INLINE int gltf_is_mirror(const Surface s) {
    return HAS_SPECULAR && s.alpha < MIRROR_ALPHA;
}

// By channel, what a thin wall that is smooth lets straight through of light that arrives under
// `cosine`; 0 of other surfaces. It is no lobe that is sampled: rays are passed on as they are
// (stages/pass_walls.cl, stages/connect_through_media.cl).
INLINE Vec3 gltf_straight_through(const Surface s, const float cosine) {
    const Vec3 none = vec3(0.0f, 0.0f, 0.0f);
    return HAS_SMOOTH_WALLS && gltf_is_mirror(s) ? gltf_reflectance(s, cosine).through : none;
}

// Probabilities that sampling takes the specular lobe, and the one through: their shares of what
// normal-facing facets scatter.
typedef struct {
    float specular, through;
} LobeChances;

INLINE LobeChances gltf_lobe_pmf(const Surface s, const Vec3 wo) {
    LobeChances c;
    c.specular = 0.0f;
    c.through = 0.0f;
    if (!HAS_SPECULAR) return c;
    const Reflectance r = gltf_reflectance(s, wo.z);
    const float specular = max_component3(r.specular);
    const float through = gltf_is_mirror(s) ? 0.0f : max_component3(r.through);
    const float sum = specular + max_component3(r.diffuse) + (HAS_TRANSMISSION ? through : 0.0f);
    const float share = sum > 0.0f ? specular / sum : 0.0f;
    // uniform in projected solid angle for every lobe that is not a delta
    c.specular = SAMPLE_LOBES || gltf_is_mirror(s) ? share : 0.0f;
    if (HAS_TRANSMISSION) c.through = sum > 0.0f ? through / sum : 0.0f;
    return c;
}

// f cos of the lobes that are not deltas, on one side.
INLINE Vec3 gltf_eval(const Surface s, const Vec3 wo, const Vec3 wi, const int through) {
    if (!HAS_SPECULAR) return scale3(s.base, lambert_eval(wi));
    const Vec3 m = normalize3(add3(wo, wi));
    const Reflectance r = gltf_reflectance(s, dot3(wo, m));
    const float ggx = gltf_is_mirror(s) ? 0.0f : ggx_eval(wo, wi, m, s.alpha);
    Vec3 value = madd3(scale3(r.diffuse, lambert_eval(wi)), r.specular, ggx);
    if (HAS_TRANSMISSION) value = select3(through, scale3(r.through, ggx), value);
    return select3(wi.z > 0.0f, value, vec3(0.0f, 0.0f, 0.0f));
}

// pdf_w [1/sr] of gltf_sample, without its deltas, on one side.
INLINE float gltf_pdf_w(const Surface s, const Vec3 wo, const Vec3 wi, const int through) {
    if (!HAS_SPECULAR) return lambert_pdf_w(wi);
    const LobeChances pmf = gltf_lobe_pmf(s, wo);
    const float ggx = gltf_is_mirror(s) ? 0.0f : ggx_pdf_w(wo, normalize3(add3(wo, wi)), s.alpha);
    float pdf_w = pmf.specular > 0.0f
                      ? fma(pmf.specular, ggx, (1.0f - pmf.specular) * lambert_pdf_w(wi))
                      : lambert_pdf_w(wi);
    if (HAS_TRANSMISSION) {
        const float diffuse = 1.0f - pmf.specular - pmf.through;
        const float above = fma(pmf.specular, ggx, diffuse * lambert_pdf_w(wi));
        const float spread = SAMPLE_LOBES ? ggx : lambert_pdf_w(wi);
        pdf_w = through ? pmf.through * spread : above;
    }
    return wi.z > 0.0f ? pdf_w : 0.0f;
}

// Of the samples of a surface, those that follow neither a specular lobe nor go through.
INLINE float gltf_diffuse_share(const Surface s, const Vec3 wo) {
    const LobeChances pmf = gltf_lobe_pmf(s, wo);
    return max(0.0f, 1.0f - pmf.specular - pmf.through);
}

typedef struct {
    Vec3 wi;
    Vec3 weight;  // f cos / pdf_w; 0: absorbed
    float pdf_w;  // [1/sr], or PDF_CERTAIN from a delta
    int through;  // wi.z < 0: to the other side
} BsdfSample;

INLINE Vec3 through_wall(const Vec3 wi) {
    return vec3(wi.x, wi.y, -wi.z);
}

INLINE BsdfSample gltf_sample(const Surface s, const Vec3 wo, const Sample2 u, const float choice) {
    BsdfSample r;
    r.wi = lambert_sample(u);
    r.through = 0;
    if (!HAS_SPECULAR) {
        r.weight = s.base;
        r.pdf_w = lambert_pdf_w(r.wi);
        return r;
    }
    const LobeChances pmf = gltf_lobe_pmf(s, wo);
    const int through = HAS_TRANSMISSION && choice >= 1.0f - pmf.through;
    const int specular = choice < pmf.specular;
    const int mirror = gltf_is_mirror(s);
    const Vec3 m =
        select3(mirror, vec3(0.0f, 0.0f, 1.0f), ggx_sample(wo, max(s.alpha, MIRROR_ALPHA), u));
    const Vec3 reflected = sub3(scale3(m, 2.0f * dot3(wo, m)), wo);
    int facet = specular;
    if (HAS_TRANSMISSION && SAMPLE_LOBES) facet |= through;
    r.wi = select3(facet, reflected, r.wi);

    const int delta = facet && mirror;
    const float pdf_w = gltf_pdf_w(s, wo, r.wi, through);
    const Vec3 finite = scale3(gltf_eval(s, wo, r.wi, through), pdf_w > 0.0f ? 1.0f / pdf_w : 0.0f);
    const Reflectance facing = gltf_reflectance(s, wo.z);
    const Vec3 certain = scale3(facing.specular, pmf.specular > 0.0f ? 1.0f / pmf.specular : 0.0f);
    r.weight = select3(delta, certain, finite);
    r.pdf_w = delta ? PDF_CERTAIN : pdf_w;
    if (HAS_TRANSMISSION) {
        r.through = through;
        r.wi = select3(through, through_wall(r.wi), r.wi);
    }
    return r;
}
