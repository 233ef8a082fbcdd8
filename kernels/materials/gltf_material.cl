// glTF 2.0 metallic-roughness (appendix B) with KHR_materials_ior and KHR_materials_specular:
//   f_r = D V [(1 - metallic) specular F + metallic F_metal] + (1 - metallic) (1 - specular max F)
//   base / pi
// The dielectric's layering gains energy at grazing angles by specification (the appendix says so
// itself). Directions are in the shading frame, leaving the surface, with wo.z > 0.
#pragma once

#include "materials/fresnel.cl"
#include "materials/ggx.cl"
#include "materials/lambert.cl"
#include "shared/features.h"
#include "shared/inline.h"
#include "shared/path.h"

typedef struct {
    Vec3 base;       // [1]
    Vec3 f0;         // [1] of the dielectric
    float metallic;  // [1]
    float specular;  // [1] weight of the dielectric's specular layer
    float alpha;     // [1]
} Surface;

typedef struct {
    Vec3 specular;  // factor of D V
    Vec3 diffuse;   // albedo of the Lambert part
} Reflectance;

// Both factors for a microfacet that sees wo under `cosine` = wo.m.
INLINE Reflectance gltf_reflectance(const Surface s, const float cosine) {
    Reflectance r;
    if (!HAS_SPECULAR) {
        r.specular = vec3(0.0f, 0.0f, 0.0f);
        r.diffuse = s.base;
        return r;
    }
    const float weight = schlick_weight(cosine);
    const Vec3 dielectric = scale3(schlick(s.f0, weight), s.specular);
    const Vec3 metal = schlick(s.base, weight);
    const float dielectric_share = 1.0f - s.metallic;
    r.specular = madd3(scale3(dielectric, dielectric_share), metal, s.metallic);
    r.diffuse = scale3(s.base, dielectric_share * (1.0f - max_component3(dielectric)));
    return r;
}

INLINE int gltf_is_mirror(const Surface s) {
    return HAS_SPECULAR && s.alpha < MIRROR_ALPHA;
}

// Probability that sampling takes the specular lobe: its share of what is reflected at
// normal-facing facets.
INLINE float gltf_specular_pmf(const Surface s, const Vec3 wo) {
    if (!HAS_SPECULAR) return 0.0f;
    const Reflectance r = gltf_reflectance(s, wo.z);
    const float specular = max_component3(r.specular);
    const float sum = specular + max_component3(r.diffuse);
    const float share = sum > 0.0f ? specular / sum : 0.0f;
    // uniform in projected solid angle for every lobe that is not a delta
    return SAMPLE_LOBES || gltf_is_mirror(s) ? share : 0.0f;
}

// f_r cos of the lobes that are not deltas.
INLINE Vec3 gltf_eval(const Surface s, const Vec3 wo, const Vec3 wi) {
    if (!HAS_SPECULAR) return scale3(s.base, lambert_eval(wi));
    const Vec3 m = normalize3(add3(wo, wi));
    const Reflectance r = gltf_reflectance(s, dot3(wo, m));
    const float ggx = gltf_is_mirror(s) ? 0.0f : ggx_eval(wo, wi, m, s.alpha);
    const Vec3 value = madd3(scale3(r.diffuse, lambert_eval(wi)), r.specular, ggx);
    return select3(wi.z > 0.0f, value, vec3(0.0f, 0.0f, 0.0f));
}

// pdf_w [1/sr] of gltf_sample, without its delta.
INLINE float gltf_pdf_w(const Surface s, const Vec3 wo, const Vec3 wi) {
    if (!HAS_SPECULAR) return lambert_pdf_w(wi);
    const float pmf = gltf_specular_pmf(s, wo);
    const float ggx = gltf_is_mirror(s) ? 0.0f : ggx_pdf_w(wo, normalize3(add3(wo, wi)), s.alpha);
    const float pdf_w =
        pmf > 0.0f ? fma(pmf, ggx, (1.0f - pmf) * lambert_pdf_w(wi)) : lambert_pdf_w(wi);
    return wi.z > 0.0f ? pdf_w : 0.0f;
}

typedef struct {
    Vec3 wi;
    Vec3 weight;  // f_r cos / pdf_w; 0: absorbed
    float pdf_w;  // [1/sr], or PDF_CERTAIN from a delta
} BsdfSample;

INLINE BsdfSample gltf_sample(const Surface s, const Vec3 wo, const Sample2 u, const float choice) {
    BsdfSample r;
    r.wi = lambert_sample(u);
    if (!HAS_SPECULAR) {
        r.weight = s.base;
        r.pdf_w = lambert_pdf_w(r.wi);
        return r;
    }
    const float pmf = gltf_specular_pmf(s, wo);
    const int specular = choice < pmf;
    const int mirror = gltf_is_mirror(s);
    const Vec3 m =
        select3(mirror, vec3(0.0f, 0.0f, 1.0f), ggx_sample(wo, max(s.alpha, MIRROR_ALPHA), u));
    const Vec3 reflected = sub3(scale3(m, 2.0f * dot3(wo, m)), wo);
    r.wi = select3(specular, reflected, r.wi);

    const int delta = specular && mirror;
    const float pdf_w = gltf_pdf_w(s, wo, r.wi);
    const Vec3 finite = scale3(gltf_eval(s, wo, r.wi), pdf_w > 0.0f ? 1.0f / pdf_w : 0.0f);
    const Vec3 certain = scale3(gltf_reflectance(s, wo.z).specular, pmf > 0.0f ? 1.0f / pmf : 0.0f);
    r.weight = select3(delta, certain, finite);
    r.pdf_w = delta ? PDF_CERTAIN : pdf_w;
    return r;
}
