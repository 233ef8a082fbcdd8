// Textures as kernels see them: how a material reads an image. The texels themselves are words of
// up to TEXTURE_MOST_PAGES buffers (materials/texture.cl, src/prepare/texture_tables.cpp).
#ifndef WAVEPATH_TEXTURE_H
#define WAVEPATH_TEXTURE_H

#include "shared/cl_types.h"

// What a material's textures are for: its rows of DeviceTexture, in this order.
enum TextureUse {
    TEXTURE_BASE_COLOR,          // rgb: base colour, a: alpha
    TEXTURE_METALLIC_ROUGHNESS,  // g: roughness, b: metallic
    TEXTURE_NORMAL,              // rgb: tangent-space normal, 0 .. 1 for -1 .. 1
    TEXTURE_EMISSION,            // rgb
    TEXTURE_SPECULAR,            // a: specular
    TEXTURE_SPECULAR_COLOR,      // rgb
    TEXTURE_TRANSMISSION,        // r: transmission
    TEXTURE_USES
};

// Bits of DeviceTexture::flags.
#define TEXTURE_CLAMP_S 1u
#define TEXTURE_MIRROR_S 2u  // neither: repeat
#define TEXTURE_CLAMP_T 4u
#define TEXTURE_MIRROR_T 8u
#define TEXTURE_NEAREST 16u      // else bilinear
#define TEXTURE_16_BITS 32u      // a channel; else 8
#define TEXTURE_SRGB 64u         // rgb follow the sRGB curve; alpha never does
#define TEXTURE_SECOND_UVS 128u  // reads the second set of texture coordinates
#define TEXTURE_MASK 256u        // TEXTURE_BASE_COLOR: alpha below the cutoff is a hole
#define TEXTURE_BLEND 512u       // TEXTURE_BASE_COLOR: alpha is the share that is covered
#define TEXTURE_TINTED 1024u     // TEXTURE_EMISSION: vertex colours multiply (unlit materials)

// width 0: no image, every channel is 1.
typedef struct {
    shared_uint first_word;  // of its texels
    shared_uint width;
    shared_uint height;
    shared_uint flags;
    // KHR_texture_transform: coordinates into the image = (s_u u + s_v v + s_1, t_u u + t_v v +
    // t_1)
    shared_float s_u, s_v, s_1;
    shared_float t_u, t_v, t_1;
    shared_float scale;   // [1] TEXTURE_NORMAL: of x and y; TEXTURE_BASE_COLOR: factor of alpha
    shared_float cutoff;  // [1] with TEXTURE_MASK
} DeviceTexture;
SHARED_SIZE(DeviceTexture, 48);

// Texel words, before those of the first image: the sRGB curve of 8-bit codes, as float bits, and
// of 16-bit ones where an image has them.
#define SRGB_8_TABLE 0u
#define SRGB_16_TABLE 256u

// A device allows a quarter of its memory in one buffer at least [OpenCL 1.2, table 4.3]: four hold
// all that fits.
#define TEXTURE_MOST_PAGES 4

#endif
