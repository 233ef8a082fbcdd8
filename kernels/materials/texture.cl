// Textures: the one place that knows how texels are kept. A texel is one word of four 8-bit codes,
// red lowest, or two words of 16-bit codes; rows run from the top, as glTF's v does. Words are
// counted through all pages of TEXTURE_PAGE_WORDS each.
#pragma once

#include "shared/features.h"
#include "shared/inline.h"
#include "shared/texture.h"

#ifndef TEXTURE_PAGES
#define TEXTURE_PAGES 2
#endif
#ifndef TEXTURE_PAGE_WORDS
#define TEXTURE_PAGE_WORDS 33554432u
#endif

// What a kernel that reads textures has among its parameters, and what it makes of them.
#define TEXTURE_PARAMETERS                                                               \
    global const DeviceTexture *restrict textures, global const uint *restrict texels_0, \
        global const uint *restrict texels_1, global const uint *restrict texels_2,      \
        global const uint *restrict texels_3
#define TEXTURES texture_memory(textures, texels_0, texels_1, texels_2, texels_3)

typedef struct {
    global const DeviceTexture* rows;  // TEXTURE_USES a material
    global const uint* page_0;
    global const uint* page_1;
    global const uint* page_2;
    global const uint* page_3;
} Textures;

INLINE Textures texture_memory(
    global const DeviceTexture* rows,
    global const uint* page_0,
    global const uint* page_1,
    global const uint* page_2,
    global const uint* page_3) {
    Textures t;
    t.rows = rows;
    t.page_0 = page_0;
    t.page_1 = page_1;
    t.page_2 = page_2;
    t.page_3 = page_3;
    return t;
}

INLINE global const DeviceTexture* texture_row(
    const Textures textures, const int material, const int use) {
    return textures.rows + (material * TEXTURE_USES + use);
}

typedef struct {
    float r, g, b, a;
} Texel;

INLINE Texel texel(const float r, const float g, const float b, const float a) {
    Texel t;
    t.r = r;
    t.g = g;
    t.b = b;
    t.a = a;
    return t;
}

INLINE Texel mix_texels(const Texel a, const Texel b, const float t) {
    return texel(
        fma(b.r - a.r, t, a.r), fma(b.g - a.g, t, a.g), fma(b.b - a.b, t, a.b),
        fma(b.a - a.a, t, a.a));
}

INLINE uint texture_word(const Textures textures, const uint address) {
    if (TEXTURE_PAGES <= 1) return textures.page_0[address];
    const uint page = address / TEXTURE_PAGE_WORDS;
    global const uint* words = page == 0   ? textures.page_0
                               : page == 1 ? textures.page_1
                               : page == 2 ? textures.page_2
                                           : textures.page_3;
    return words[address - page * TEXTURE_PAGE_WORDS];
}

INLINE float decode_channel(
    const Textures textures, const uint code, const int wide, const int srgb) {
    if (srgb) return as_float(texture_word(textures, (wide ? SRGB_16_TABLE : SRGB_8_TABLE) + code));
    return (float)code / (wide ? 65535.0f : 255.0f);
}

// The texel in this column and row, linear.
INLINE Texel
texture_texel(const Textures textures, const DeviceTexture* row, const int x, const int y) {
    const uint index = (uint)y * row->width + (uint)x;
    const int wide = (row->flags & TEXTURE_16_BITS) != 0;
    const int srgb = (row->flags & TEXTURE_SRGB) != 0;
    uint codes[4];
    if (wide) {
        const uint low = texture_word(textures, row->first_word + 2 * index);
        const uint high = texture_word(textures, row->first_word + 2 * index + 1);
        codes[0] = low & 65535u;
        codes[1] = low >> 16;
        codes[2] = high & 65535u;
        codes[3] = high >> 16;
    } else {
        const uint word = texture_word(textures, row->first_word + index);
        codes[0] = word & 255u;
        codes[1] = word >> 8 & 255u;
        codes[2] = word >> 16 & 255u;
        codes[3] = word >> 24;
    }
    return texel(
        decode_channel(textures, codes[0], wide, srgb),
        decode_channel(textures, codes[1], wide, srgb),
        decode_channel(textures, codes[2], wide, srgb),
        decode_channel(textures, codes[3], wide, 0));
}

// The two texels around a coordinate along one side of the image, and the second one's share.
typedef struct {
    int first, second;
    float share;
} TexelPair;

INLINE TexelPair
texel_pair(const float given, const int size, const int clamps, const int mirrors) {
    // beyond 2^30 floats hold whole turns alone; infinity and NaN would lead outside the image
    const float coordinate = fmax(fmin(given, 0x1p30f), -0x1p30f);
    const float half_turns = 0.5f * coordinate;
    const float turn = 2.0f * (half_turns - floor(half_turns));
    const float mirrored = turn > 1.0f ? 2.0f - turn : turn;
    const float repeated = coordinate - floor(coordinate);
    const float within = clamps ? clamp(coordinate, 0.0f, 1.0f) : (mirrors ? mirrored : repeated);
    const float x = fma(within, (float)size, -0.5f);
    const int column = (int)floor(x);
    TexelPair pair;
    pair.share = x - (float)column;
    pair.first = max(column, 0);
    pair.second = min(column + 1, size - 1);
    if (!clamps && !mirrors) {
        pair.first = column < 0 ? size - 1 : column;
        pair.second = column + 1 >= size ? 0 : column + 1;
    }
    return pair;
}

// The image at (s, t), t downwards, wrapped and filtered as the row says; filtered after decoding
// [glTF 2.0, section 3.9.2].
INLINE Texel texture_eval(
    const Textures textures, global const DeviceTexture* texture, const float s, const float t) {
    const DeviceTexture row = *texture;
    if (row.width == 0) return texel(1.0f, 1.0f, 1.0f, 1.0f);
    const TexelPair x = texel_pair(
        s, (int)row.width, (row.flags & TEXTURE_CLAMP_S) != 0, (row.flags & TEXTURE_MIRROR_S) != 0);
    const TexelPair y = texel_pair(
        t, (int)row.height, (row.flags & TEXTURE_CLAMP_T) != 0,
        (row.flags & TEXTURE_MIRROR_T) != 0);
    if (row.flags & TEXTURE_NEAREST)
        return texture_texel(
            textures, &row, x.share < 0.5f ? x.first : x.second,
            y.share < 0.5f ? y.first : y.second);
    const Texel top = mix_texels(
        texture_texel(textures, &row, x.first, y.first),
        texture_texel(textures, &row, x.second, y.first), x.share);
    const Texel bottom = mix_texels(
        texture_texel(textures, &row, x.first, y.second),
        texture_texel(textures, &row, x.second, y.second), x.share);
    return mix_texels(top, bottom, y.share);
}
