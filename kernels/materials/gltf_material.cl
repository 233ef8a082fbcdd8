// glTF 2.0 metallic-roughness (appendix B) with KHR_materials_ior and KHR_materials_specular:
//   f_r = [(1 - metallic) specular F + metallic F_metal] D V
//         + (1 - metallic) base (1 - transmission) d
// and, to the other side of a thin wall (KHR_materials_transmission), with wi mirrored in D V and
// F,
//   f_t = (1 - metallic) base transmission [(1 - specular max F) D V + l]
// With LAYERS_CONSERVE, d and l are what is left below a specular layer of the albedo E(mu) =
// specular max(f0 A + B), and what its facets lose, M (materials/layer_albedo.cl) [Kelemen &
// Szirmay-Kalos 2001; Kulla & Conty 2017],
//   d = (1 - E(wo)) (1 - E(wi)) / (pi mean(1 - E)),   l = M(wo) M(wi) / (pi mean(M)),
// with the mean over the projected hemisphere, so that white has the albedo 1 from every side.
// Without, by the letter of glTF,
//   d = (1 - specular max F) / pi,   l = 0,
// which gains energy at grazing angles (the appendix says so itself). Directions are in the shading
// frame, leaving the surface, with wo.z > 0; wi.z < 0 has gone through. Below, `through` picks f_t,
// for which wi is given mirrored: wi.z > 0 too.
#pragma once

#include "materials/fresnel.cl"
#include "materials/ggx.cl"
#include "materials/lambert.cl"
#include "materials/layer_albedo.cl"
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
    float diffuse;  // of base / pi
    float through;  // of base D V of the other side
    float spread;   // of base / pi of the other side
} Reflectance;

// The factors by the letter of glTF, for a microfacet that sees wo under `cosine` = wo.m.
INLINE Reflectance gltf_reflectance(const Surface s, const float cosine) {
    Reflectance r;
    r.spread = 0.0f;
    if (!HAS_SPECULAR) {
        r.specular = vec3(0.0f, 0.0f, 0.0f);
        r.diffuse = 1.0f;
        r.through = 0.0f;
        return r;
    }
    const float weight = schlick_weight(cosine);
    const Vec3 dielectric = scale3(schlick(s.f0, weight), s.specular);
    const Vec3 metal = schlick(s.base, weight);
    const float dielectric_share = 1.0f - s.metallic;
    r.specular = madd3(scale3(dielectric, dielectric_share), metal, s.metallic);
    const float entered = dielectric_share * (1.0f - max_component3(dielectric));
    r.diffuse = HAS_TRANSMISSION ? entered * (1.0f - s.transmission) : entered;
    r.through = HAS_TRANSMISSION ? entered * s.transmission : 0.0f;
    return r;
}

// Means below this are taken for it: of mirrors, whose facets lose nothing.
#define LEAST_LAYER_MEAN 1e-6f

// 1 - E of the dielectric's layer.
INLINE float layer_passes(const Surface s, const LayerAlbedo a) {
    const float f0 = max_component3(s.f0);
    const float passed = fma(f0, a.missing, (1.0f - f0) * (1.0f - a.grazing));
    return fma(s.specular, passed, 1.0f - s.specular);
}

// Of the dielectric and the metal together, at f0 and f90 with these weights. As short as can be:
// LLVM would join the channels of a longer one to vectors, and PoCL leave the kernel around them
// scalar.
INLINE Vec3 layer_specular(const Surface s, const float facing, const float grazing) {
    const float dielectric = (1.0f - s.metallic) * s.specular;
    const Vec3 f0 = madd3(scale3(s.base, s.metallic), s.f0, dielectric);
    const float f90 = (dielectric + s.metallic) * grazing;
    return madd3(vec3(f90, f90, f90), f0, facing);
}

// The factors for wo and wi whose half-vector they see under `cosine`.
INLINE Reflectance
layered_reflectance(const Surface s, const Vec3 wo, const Vec3 wi, const float cosine) {
    if (!LAYERS_CONSERVE) return gltf_reflectance(s, cosine);
    const LayerRows rows = layer_rows(s.alpha);
    const LayerAlbedo from = layer_albedo(rows, wo.z);
    const LayerAlbedo towards = layer_albedo(rows, wi.z);
    const LayerAlbedo mean = layer_mean_albedo(rows);
    const float weight = schlick_weight(cosine);
    const float passed = layer_passes(s, from) * layer_passes(s, towards) /
                         max(layer_passes(s, mean), LEAST_LAYER_MEAN);
    Reflectance r;
    r.specular = layer_specular(s, 1.0f - weight, weight);
    r.diffuse = (1.0f - s.metallic) * passed;
    r.through = 0.0f;
    r.spread = 0.0f;
    if (HAS_TRANSMISSION) {
        const float through = (1.0f - s.metallic) * s.transmission;
        const float fresnel = fma(max_component3(s.f0), 1.0f - weight, weight);
        const float lost = from.missing * towards.missing / max(mean.missing, LEAST_LAYER_MEAN);
        r.diffuse *= 1.0f - s.transmission;
        r.through = through * fma(-s.specular, fresnel, 1.0f);
        r.spread = through * lost;
    }
    return r;
}

// The albedos of the lobes, seen under `cosine`; all but the specular one are factors of the base.
INLINE Reflectance lobe_albedos(const Surface s, const float cosine) {
    if (!LAYERS_CONSERVE) return gltf_reflectance(s, cosine);
    const LayerAlbedo a = layer_albedo(layer_rows(s.alpha), cosine);
    const float passed = layer_passes(s, a);
    Reflectance r;
    r.specular = layer_specular(s, 1.0f - a.missing - a.grazing, a.grazing);
    r.diffuse = (1.0f - s.metallic) * passed;
    r.through = 0.0f;
    r.spread = 0.0f;
    if (HAS_TRANSMISSION) {
        const float through = (1.0f - s.metallic) * s.transmission;
        r.diffuse *= 1.0f - s.transmission;
        r.through = through * max(passed - a.missing, 0.0f);
        r.spread = through * a.missing;
    }
    return r;
}

INLINE int gltf_is_mirror(const Surface s) {
    return HAS_SPECULAR && s.alpha < MIRROR_ALPHA;
}

// By channel, what a thin wall that is smooth lets straight through of light that arrives under
// `cosine`; 0 of other surfaces. It is no lobe that is sampled: rays are passed on as they are
// (stages/pass_walls.cl, stages/connect_through_media.cl).
INLINE Vec3 gltf_straight_through(const Surface s, const float cosine) {
    if (!HAS_SMOOTH_WALLS) return vec3(0.0f, 0.0f, 0.0f);
    // First for all, then chosen: LLVM 18 as PoCL 6.0 runs it gives up on the branch.
    const float through = lobe_albedos(s, cosine).through;
    return scale3(s.base, gltf_is_mirror(s) ? through : 0.0f);
}

// Probabilities that sampling takes the specular lobe, and those to the other side: their shares of
// the albedo (by the letter of glTF, of what leaves normal-facing facets).
typedef struct {
    float specular;
    float through;   // to the other side
    float straight;  // of these, by microfacets
} LobeChances;

INLINE LobeChances gltf_lobe_pmf(const Surface s, const Vec3 wo) {
    LobeChances c;
    c.specular = 0.0f;
    c.through = 0.0f;
    c.straight = 0.0f;
    if (!HAS_SPECULAR) return c;
    const Reflectance r = lobe_albedos(s, wo.z);
    const float specular = max_component3(r.specular);
    const float base = max_component3(s.base);
    const float straight = gltf_is_mirror(s) ? 0.0f : base * r.through;
    const float through = fma(base, r.spread, straight);
    const float sum = fma(base, r.diffuse, specular) + (HAS_TRANSMISSION ? through : 0.0f);
    const float share = sum > 0.0f ? specular / sum : 0.0f;
    const int by_facets = SAMPLE_LOBES || gltf_is_mirror(s);
    // uniform in projected solid angle for every lobe that is not a delta
    c.specular = by_facets ? share : 0.0f;
    if (HAS_TRANSMISSION) {
        c.through = sum > 0.0f ? through / sum : 0.0f;
        c.straight = by_facets && sum > 0.0f ? straight / sum : 0.0f;
    }
    return c;
}

// f cos of the lobes that are not deltas, on one side.
INLINE Vec3 gltf_eval(const Surface s, const Vec3 wo, const Vec3 wi, const int through) {
    if (!HAS_SPECULAR) return scale3(s.base, lambert_eval(wi));
    const Vec3 m = normalize3(add3(wo, wi));
    const Reflectance r = layered_reflectance(s, wo, wi, dot3(wo, m));
    const float ggx = gltf_is_mirror(s) ? 0.0f : ggx_eval(wo, wi, m, s.alpha);
    const float lambert = lambert_eval(wi);
    Vec3 value = madd3(scale3(s.base, r.diffuse * lambert), r.specular, ggx);
    if (HAS_TRANSMISSION)
        value = select3(through, scale3(s.base, fma(r.spread, lambert, r.through * ggx)), value);
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
        const float below =
            fma(pmf.straight, ggx, (pmf.through - pmf.straight) * lambert_pdf_w(wi));
        pdf_w = through ? below : above;
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
    if (HAS_TRANSMISSION) facet |= choice >= 1.0f - pmf.straight;
    r.wi = select3(facet, reflected, r.wi);

    const int delta = facet && mirror;
    const float pdf_w = gltf_pdf_w(s, wo, r.wi, through);
    const Vec3 finite = scale3(gltf_eval(s, wo, r.wi, through), pdf_w > 0.0f ? 1.0f / pdf_w : 0.0f);
    const Vec3 mirrored = lobe_albedos(s, wo.z).specular;
    const Vec3 certain = scale3(mirrored, pmf.specular > 0.0f ? 1.0f / pmf.specular : 0.0f);
    r.weight = select3(delta, certain, finite);
    r.pdf_w = delta ? PDF_CERTAIN : pdf_w;
    if (HAS_TRANSMISSION) {
        r.through = through;
        r.wi = select3(through, through_wall(r.wi), r.wi);
    }
    return r;
}
