// Normals to shade by, and what keeps them from losing light or letting it through.
//
// A lobe around a tilted normal reaches below the face. What it sends there is mirrored at the
// face's plane: f(wi) becomes f(wi) + f(wi mirrored), so that nothing goes through and the lobe's
// albedo stays what it is. (A facet's light that meets the surface again goes on upwards, as from
// the mirror facet of [Schuessler 2017, section 3]; [Veach 1997, section 5.3] shows what
// clipping would lose and what leaving it would leak.)
#pragma once

#include "materials/gltf_material.cl"
#include "sampling/vector.cl"
#include "shared/inline.h"

// `v` mirrored at the plane with unit normal `n`.
INLINE Vec3 mirror3(const Vec3 v, const Vec3 n) {
    return madd3(v, n, -2.0f * dot3(v, n));
}

// A normal that the face and the viewer see from its front. `n`: unit, any; `ng`: the face's, on
// the viewer's side; `wo`: towards the viewer. First mirrored at the face, then at the plane across
// the line of sight; each step leaves alone what is right already and is continuous where it
// begins.
INLINE Vec3 visible_normal(const Vec3 n, const Vec3 ng, const Vec3 wo) {
    const Vec3 above = select3(dot3(n, ng) < 0.0f, mirror3(n, ng), n);
    return select3(dot3(above, wo) < 0.0f, mirror3(above, wo), above);
}

// The material's lobes around the normal of `frame`, on a face of normal `ng`; directions in the
// world. f cos and pdf_w of those that leave on wi's side of the face.
typedef struct {
    Vec3 value;   // f cos
    float pdf_w;  // [1/sr]
} Scattered;

INLINE Scattered scatter_towards(
    const Surface surface, const Frame frame, const Vec3 ng, const Vec3 wo, const Vec3 wi) {
    const int through = HAS_TRANSMISSION && dot3(ng, wi) < 0.0f;
    const Vec3 above = to_local(frame, wi);
    const Vec3 direct = select3(through, through_wall(above), above);
    Scattered r;
    r.value = gltf_eval(surface, wo, direct, through);
    r.pdf_w = gltf_pdf_w(surface, wo, direct, through);
    if (HAS_SHADING_NORMALS) {
        const Vec3 other = to_local(frame, mirror3(wi, ng));
        const Vec3 mirrored = select3(through, through_wall(other), other);
        r.value = add3(r.value, gltf_eval(surface, wo, mirrored, through));
        r.pdf_w += gltf_pdf_w(surface, wo, mirrored, through);
    }
    return r;
}
