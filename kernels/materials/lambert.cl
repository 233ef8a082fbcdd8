// Lambert's reflector: f_r = albedo / pi. Directions are in the shading frame, leaving the surface.
#pragma once

#include "sampling/warp.cl"
#include "shared/inline.h"

INLINE float lambert_eval(const Vec3 wi) {
    return max(wi.z, 0.0f) * INV_PI_F;  // f_r cos for albedo 1
}

INLINE float lambert_pdf_w(const Vec3 wi) {
    return max(wi.z, 0.0f) * INV_PI_F;
}

INLINE Vec3 lambert_sample(const Sample2 u) {
    return sample_cosine(u);
}
