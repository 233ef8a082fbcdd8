// Adds what the surface that was hit emits towards the viewer.
//
// reads: rays, hits, surfaces, throughputs, radiances, triangles, materials, lights, textures
// (emission)
//
// writes: radiances
//
// One work-item a slot.

#include "geometry/interaction.cl"
#include "geometry/path_state.cl"
#include "geometry/surface_texture.cl"
#include "lights/area_light.cl"
#include "shared/params.h"

kernel void shade_emission(
    constant const RenderParams* restrict settings,
    const uint slots,
    global const float* restrict triangles,
    global const DeviceMaterial* restrict materials,
    global const DeviceLight* restrict lights,
    TEXTURE_PARAMETERS,
    global const float* restrict rays,
    global const float* restrict hits,
    global const float* restrict surfaces,
    global const float* restrict throughputs,
    global float* restrict radiances) {
    const size_t stride = settings->stride;
    const size_t slot = get_global_id(0);
    if (slot >= slots) return;
    if (!at_surface(hit_of(hits, stride, slot))) return;
    if (is_resumed(hits, stride, slot)) return;
    const uint row = as_uint(PLANE(surfaces, SURFACE_LIGHT)[slot]);
    if (row == NO_LIGHT) return;
    global const DeviceMaterial* material =
        materials + as_int(PLANE(surfaces, SURFACE_MATERIAL)[slot]);
    Vec3 emission = vec3(material->emission_r, material->emission_g, material->emission_b);
    if (HAS_EMISSION_TEXTURES) {
        const size_t primitive = (size_t)hit_of(hits, stride, slot);
        emission = mul3(
            emission, emission_on_triangle(
                          TEXTURES, triangles + TRIANGLE_FLOATS * primitive,
                          PLANE(hits, HIT_U)[slot], PLANE(hits, HIT_V)[slot]));
    }
    const float pdf_w = PLANE(throughputs, THROUGHPUT_PDF)[slot];

    // Light sampling could have chosen this point too: leave it its share (direct: all of it).
    float weight = 1.0f;
    if (SAMPLE_LIGHTS) {
        const Vec3 ng = load3(PLANE(surfaces, SURFACE_NG_X), stride, slot);
        const float cos_light = -dot3(ng, load3(PLANE(rays, RAY_DIRECTION_X), stride, slot));
        const float distance = PLANE(hits, HIT_T)[slot];
        const float light_pdf_w = area_light_pdf_w(
            triangles + (size_t)TRIANGLE_FLOATS * hit_of(hits, stride, slot), lights + (int)row,
            load3(PLANE(rays, RAY_ORIGIN_X), stride, slot), distance * distance, cos_light);
        const float share = WEIGH_BOTH ? power_heuristic(pdf_w, light_pdf_w) : 0.0f;
        weight = pdf_w == PDF_CERTAIN ? 1.0f : share;
    }
    const Vec3 carried = scale3(load3(PLANE(throughputs, THROUGHPUT_R), stride, slot), weight);
    global float* radiance = PLANE(radiances, RADIANCE_R);
    store3(radiance, stride, slot, add3(load3(radiance, stride, slot), mul3(carried, emission)));
}
