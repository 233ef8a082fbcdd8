// The directional albedo of the specular layer, A f0 + B f90, and what conserves energy below it
// [Kelemen & Szirmay-Kalos 2001; Kulla & Conty 2017]. With Schlick's weight w = (1 - wo.m)^5,
//   A = integral of D V (1 - w) cos,   B = integral of D V w cos,   M = 1 - A - B,
// and M is what single scattering between microfacets loses. All from a table of 16 KiB
// (scripts/layer_albedo.py) that is right to 2e-4 in M and 4e-4 in B, 2e-5 and 6e-5 on average.
#pragma once

#include "materials/fresnel.cl"
#include "materials/ggx.cl"
#include "materials/layer_albedo_table.h"
#include "shared/inline.h"

typedef struct {
    float missing;  // [1] M
    float grazing;  // [1] B
} LayerAlbedo;

// Two neighbouring rows of the table.
typedef struct {
    float alpha;
    int mirror;
    uint row;     // where the first begins
    float share;  // [1] of the second
} LayerRows;

INLINE LayerRows layer_rows(const float alpha) {
    const float first = sqrt(MIRROR_ALPHA);
    LayerRows r;
    r.alpha = max(alpha, MIRROR_ALPHA);
    r.mirror = alpha < MIRROR_ALPHA;
    const float v = (sqrt(r.alpha) - first) * ((LAYER_ROUGHNESSES - 1) / (1.0f - first));
    const uint row = (uint)clamp(v, 0.0f, LAYER_ROUGHNESSES - 2.0f);
    r.row = row * (LAYER_COSINES + 1);
    r.share = v - (float)row;
    return r;
}

// sqrt(M) and B without its part of mirrors, in units of the table's codes.
INLINE float layer_root(const uint word) {
    return (float)(word >> 16);
}

INLINE float layer_rest(const uint word) {
    return (float)(word & 65535u);
}

// `mirror`: B of a mirror.
INLINE LayerAlbedo
layer_decoded(const LayerRows rows, const float root, const float rest, const float mirror) {
    const float missing = root * (1.0f / 65535.0f);
    LayerAlbedo a;
    a.missing = rows.mirror ? 0.0f : missing * missing;
    const float grazing = fma(rest, -64.0f / (63.0f * 65535.0f), mirror + 1.0f / 63.0f);
    a.grazing = rows.mirror ? mirror : max(grazing, 0.0f);
    return a;
}

// Seen under `cosine`. The two interpolations sum in opposite orders: in the same one LLVM's SLP
// pass joins them to vectors, and PoCL leaves the kernel around them scalar.
INLINE LayerAlbedo layer_albedo(const LayerRows rows, const float cosine) {
    const float mu = cosine > 0.0f ? min(cosine, 1.0f) : 0.0f;  // of no number, too
    const float spread = sqrt(mu * (1.0f + rows.alpha) / (mu + rows.alpha));
    const float x = fma(0.8f, spread, 0.2f * mu) * (LAYER_COSINES - 1);
    const uint column = (uint)min(x, LAYER_COSINES - 2.0f);
    const float share = x - (float)column;
    const uint at = rows.row + column;
    const uint w00 = layer_albedos[at];
    const uint w01 = layer_albedos[at + 1];
    const uint w10 = layer_albedos[at + LAYER_COSINES + 1];
    const uint w11 = layer_albedos[at + LAYER_COSINES + 2];
    const float s11 = share * rows.share;
    const float s01 = share - s11;
    const float s10 = rows.share - s11;
    const float s00 = 1.0f - share - s10;
    float root = s00 * layer_root(w00);
    root = fma(s01, layer_root(w01), root);
    root = fma(s10, layer_root(w10), root);
    root = fma(s11, layer_root(w11), root);
    float rest = s11 * layer_rest(w11);
    rest = fma(s10, layer_rest(w10), rest);
    rest = fma(s01, layer_rest(w01), rest);
    rest = fma(s00, layer_rest(w00), rest);
    return layer_decoded(rows, root, rest, schlick_weight(mu));
}

// Its mean over the projected hemisphere.
INLINE LayerAlbedo layer_mean_albedo(const LayerRows rows) {
    const uint at = rows.row + LAYER_COSINES;
    const uint low = layer_albedos[at];
    const uint high = layer_albedos[at + LAYER_COSINES + 1];
    const float root = fma(layer_root(high) - layer_root(low), rows.share, layer_root(low));
    const float rest = fma(layer_rest(high), rows.share, (1.0f - rows.share) * layer_rest(low));
    return layer_decoded(rows, root, rest, 1.0f / 21.0f);
}
