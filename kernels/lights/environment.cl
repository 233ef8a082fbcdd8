// Radiance from infinity: constant, or a latitude-longitude map with u = atan2(z, x) / 2 pi + 1/2,
// v = acos(y) / pi.
#pragma once

#include "lights/light_choice.cl"
#include "sampling/warp.cl"
#include "shared/features.h"
#include "shared/inline.h"
#include "shared/params.h"

INLINE Vec3 environment_texel(
    global const EnvironmentEntry* map, const RenderParams* params, const int x, const int y) {
    const int width = (int)params->environment_width;
    const int height = (int)params->environment_height;
    const int column = x < 0 ? x + width : (x >= width ? x - width : x);
    const int row = min(max(y, 0), height - 1);
    global const EnvironmentEntry* e = map + height + row * width + column;
    return vec3(e->r, e->g, e->b);
}

// Bilinear between texel centres, wrapped in u.
INLINE Vec3
environment_eval(global const EnvironmentEntry* map, const RenderParams* params, const Vec3 d) {
    const Vec3 scale = vec3(params->environment_r, params->environment_g, params->environment_b);
    if (!HAS_ENVIRONMENT_MAP) return scale;
    const float x = (atan2_turns(d.z, d.x) + 0.5f) * (float)params->environment_width - 0.5f;
    const float y = acos_half_turns(d.y) * (float)params->environment_height - 0.5f;
    const int column = (int)(x + 1.0f) - 1;  // floor, x >= -1/2
    const int row = (int)(y + 1.0f) - 1;
    const float fx = x - (float)column;
    const float fy = y - (float)row;
    const Vec3 top = madd3(
        scale3(environment_texel(map, params, column, row), 1.0f - fx),
        environment_texel(map, params, column + 1, row), fx);
    const Vec3 bottom = madd3(
        scale3(environment_texel(map, params, column, row + 1), 1.0f - fx),
        environment_texel(map, params, column + 1, row + 1), fx);
    return mul3(scale, madd3(scale3(top, 1.0f - fy), bottom, fy));
}

// pdf_w [1/sr] of environment_sample, without the choice of the light: uniform in (u, v) within a
// texel, so pmf * width * height / (2 pi^2 sin theta) [Pharr, Jakob, Humphreys 2023, section 12.5].
INLINE float environment_pdf_w(
    global const EnvironmentEntry* map, const RenderParams* params, const Vec3 d) {
    if (!HAS_ENVIRONMENT_MAP) return 0.25f * INV_PI_F;
    const int width = (int)params->environment_width;
    const int height = (int)params->environment_height;
    const int column = min((int)((atan2_turns(d.z, d.x) + 0.5f) * (float)width), width - 1);
    const int row = min((int)(acos_half_turns(d.y) * (float)height), height - 1);
    const float pmf = map[row].pmf * map[height + row * width + column].pmf;
    const float sine = max(sqrt(fma(d.x, d.x, d.z * d.z)), 1e-6f);
    return pmf * (float)width * (float)height * (0.5f * INV_PI_F * INV_PI_F) / sine;
}

INLINE Vec3 environment_sample(
    global const EnvironmentEntry* map, const RenderParams* params, const Bits2 bits) {
    if (!HAS_ENVIRONMENT_MAP) return sample_sphere(unit_pair(bits));
    const uint width = params->environment_width;
    const uint height = params->environment_height;
    const uint row_entry = choice_entry(bits.u, height);
    const float row_rest = unit_float(choice_rest(bits.u, height));
    const float row_threshold = map[(int)row_entry].alias_threshold;
    const int keep_row = row_rest < row_threshold;
    const uint row = keep_row ? row_entry : map[(int)row_entry].alias;
    // what is left of a number that fell below (above) the threshold is uniform again
    const float fy =
        keep_row ? row_rest / row_threshold : (row_rest - row_threshold) / (1.0f - row_threshold);

    global const EnvironmentEntry* texels = map + (int)(height + row * width);
    const uint column_entry = choice_entry(bits.v, width);
    const float column_rest = unit_float(choice_rest(bits.v, width));
    const float column_threshold = texels[(int)column_entry].alias_threshold;
    const int keep_column = column_rest < column_threshold;
    const uint column = keep_column ? column_entry : texels[(int)column_entry].alias;
    const float fx = keep_column ? column_rest / column_threshold
                                 : (column_rest - column_threshold) / (1.0f - column_threshold);

    const SineCosine phi = sincos_2pi(((float)column + fx) / (float)width - 0.5f);
    const SineCosine theta = sincos_2pi(0.5f * ((float)row + fy) / (float)height);
    return vec3(theta.sine * phi.cosine, theta.cosine, theta.sine * phi.sine);
}
