// Radiance from infinity: constant, or a latitude-longitude map with u = atan2(z, x) / 2 pi + 1/2,
// v = acos(y) / pi.
#pragma once

#include "lights/light_choice.cl"
#include "sampling/warp.cl"
#include "shared/features.h"
#include "shared/inline.h"
#include "shared/params.h"

typedef struct {
    Vec3 wi;
    Vec3 radiance;
    float pdf_w;  // [1/sr], without the choice of the light
} EnvironmentSample;

// What of a texel's luminance light points are to find: where bsdf sampling finds the environment,
// too, it is left what does not exceed the mean [Karlik et al. 2019, section 4].
INLINE float sampled_luminance(const RenderParams* params, const Vec3 texel) {
    const float luminance = fma(0.2126f, texel.x, fma(0.7152f, texel.y, 0.0722f * texel.z));
    return max(luminance - params->environment_left, 0.0f);
}

INLINE Vec3 environment_texel(
    global const EnvironmentEntry* map, const RenderParams* params, const int x, const int y) {
    const int width = (int)params->environment_width;
    const int height = (int)params->environment_height;
    const int column = x < 0 ? x + width : (x >= width ? x - width : x);
    global const EnvironmentEntry* e = map + height + 1 + max(y, 0) * width + column;
    return vec3(e->r, e->g, e->b);
}

// A cell's corners: (0, 0), (1, 0), (0, 1), (1, 1).
typedef struct {
    Vec3 radiance[4];
    float sampled[4];  // luminance
} EnvironmentCell;

INLINE EnvironmentCell environment_cell(
    global const EnvironmentEntry* map, const RenderParams* params, const int x, const int row) {
    EnvironmentCell c;
    c.radiance[0] = environment_texel(map, params, x, row - 1);
    c.radiance[1] = environment_texel(map, params, x + 1, row - 1);
    c.radiance[2] = environment_texel(map, params, x, row);
    c.radiance[3] = environment_texel(map, params, x + 1, row);
    c.sampled[0] = sampled_luminance(params, c.radiance[0]);
    c.sampled[1] = sampled_luminance(params, c.radiance[1]);
    c.sampled[2] = sampled_luminance(params, c.radiance[2]);
    c.sampled[3] = sampled_luminance(params, c.radiance[3]);
    return c;
}

// Keeps the digits of the smaller value, which a + x (b - a) does not beside a sun.
INLINE float between(const float a, const float b, const float x) {
    return fma(1.0f - x, a, x * b);
}

INLINE float bilinear(
    const float v00,
    const float v10,
    const float v01,
    const float v11,
    const float x,
    const float y) {
    return between(between(v00, v10, x), between(v01, v11, x), y);
}

// Towards the point (fx, fy) of a cell, chosen with chance pmf: radiance and sampled luminance are
// bilinear between its corners; the density follows the luminance, over the sine [Pharr, Jakob,
// Humphreys 2023, sections 12.5 and A.5].
INLINE EnvironmentSample environment_in_cell(
    const RenderParams* params,
    const EnvironmentCell c,
    const float pmf,
    const int row,
    const float fx,
    const float fy,
    const Vec3 wi) {
    EnvironmentSample s;
    s.wi = wi;
    s.radiance.x =
        params->environment_r *
        bilinear(c.radiance[0].x, c.radiance[1].x, c.radiance[2].x, c.radiance[3].x, fx, fy);
    s.radiance.y =
        params->environment_g *
        bilinear(c.radiance[0].y, c.radiance[1].y, c.radiance[2].y, c.radiance[3].y, fx, fy);
    s.radiance.z =
        params->environment_b *
        bilinear(c.radiance[0].z, c.radiance[1].z, c.radiance[2].z, c.radiance[3].z, fx, fy);
    const float height = (float)params->environment_height;
    const float cells = (float)params->environment_width * height;
    const float pole = row == 0 || row == (int)params->environment_height ? 2.0f : 1.0f;
    const float sine = max(sqrt(fma(wi.x, wi.x, wi.z * wi.z)), 1e-6f);
    const float sum = c.sampled[0] + c.sampled[1] + c.sampled[2] + c.sampled[3];
    const float here = bilinear(c.sampled[0], c.sampled[1], c.sampled[2], c.sampled[3], fx, fy);
    const float relative = sum > 0.0f ? 4.0f * here / sum : 0.0f;
    s.pdf_w = pmf * pole * relative * cells * (0.5f * INV_PI_F * INV_PI_F) / sine;
    return s;
}

// What lies in direction d, and the density of environment_sample there.
INLINE EnvironmentSample
environment_at(global const EnvironmentEntry* map, const RenderParams* params, const Vec3 d) {
    if (!HAS_ENVIRONMENT_MAP) {
        EnvironmentSample s;
        s.wi = d;
        s.radiance = vec3(params->environment_r, params->environment_g, params->environment_b);
        s.pdf_w = 0.25f * INV_PI_F;
        return s;
    }
    const int width = (int)params->environment_width;
    const int height = (int)params->environment_height;
    const float x = (atan2_turns(d.z, d.x) + 0.5f) * (float)width - 0.5f;
    const float y = acos_half_turns(d.y) * (float)height + 0.5f;
    const int column = (int)(x + 1.0f) - 1;  // floor, x >= -1/2
    const int row = min((int)y, height);
    const EnvironmentCell c = environment_cell(map, params, column, row);
    const int cell = row * width + (column < 0 ? column + width : column);
    const float pmf = map[row].pmf * map[height + 1 + cell].pmf;
    return environment_in_cell(
        params, c, pmf, row, x - (float)column, min(y - (float)row, 1.0f), d);
}

// x in [0, 1) of density in proportion to a + (b - a) x.
INLINE float sample_linear(const float a, const float b, const float u) {
    const float sum = a + b;
    const float low = a / sum;
    const float high = b / sum;
    const float x = u / (low + sqrt(fma(u, high * high, (1.0f - u) * (low * low))));
    return ((sum > 0.0f) & (x < 1.0f)) ? x : u;
}

INLINE EnvironmentSample environment_sample(
    global const EnvironmentEntry* map, const RenderParams* params, const Bits2 bits) {
    if (!HAS_ENVIRONMENT_MAP) return environment_at(map, params, sample_sphere(unit_pair(bits)));
    const uint width = params->environment_width;
    const uint height = params->environment_height;
    const uint row_entry = choice_entry(bits.u, height + 1);
    const float row_rest = unit_float(choice_rest(bits.u, height + 1));
    const float row_threshold = map[(int)row_entry].alias_threshold;
    const int keep_row = row_rest < row_threshold;
    const int row = (int)(keep_row ? row_entry : map[(int)row_entry].alias);
    // what is left of a number that fell below (above) the threshold is uniform again
    const float v =
        keep_row ? row_rest / row_threshold : (row_rest - row_threshold) / (1.0f - row_threshold);

    global const EnvironmentEntry* cells = map + (int)(height + 1) + row * (int)width;
    const uint column_entry = choice_entry(bits.v, width);
    const float column_rest = unit_float(choice_rest(bits.v, width));
    const float column_threshold = cells[(int)column_entry].alias_threshold;
    const int keep_column = column_rest < column_threshold;
    const int column = (int)(keep_column ? column_entry : cells[(int)column_entry].alias);
    const float u = keep_column ? column_rest / column_threshold
                                : (column_rest - column_threshold) / (1.0f - column_threshold);

    const EnvironmentCell c = environment_cell(map, params, column, row);
    // at the poles the corners above and below are the same, and half of the cell is not there
    const float within = sample_linear(c.sampled[0] + c.sampled[1], c.sampled[2] + c.sampled[3], v);
    const float lower = row == (int)height ? 0.5f * v : within;
    const float fy = row == 0 ? 0.5f + 0.5f * v : lower;
    const float fx = sample_linear(
        between(c.sampled[0], c.sampled[2], fy), between(c.sampled[1], c.sampled[3], fy), u);

    const SineCosine phi = sincos_2pi(((float)column + 0.5f + fx) / (float)width - 0.5f);
    const SineCosine theta = sincos_2pi(0.5f * ((float)row - 0.5f + fy) / (float)height);
    const Vec3 wi = vec3(theta.sine * phi.cosine, theta.cosine, theta.sine * phi.sine);
    const float pmf = map[row].pmf * cells[column].pmf;
    return environment_in_cell(params, c, pmf, row, fx, fy, wi);
}
