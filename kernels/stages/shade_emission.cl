// Adds what the surface that was hit emits towards the viewer.
// reads: queue, rays, hits, throughputs, scene, lights    writes: radiances
// One work-item an active path.

#include "geometry/interaction.cl"
#include "lights/area_light.cl"
#include "shared/params.h"
#include "shared/queues.h"

kernel void shade_emission(
    constant const RenderParams* restrict params,
    global const QueueSizes* restrict sizes,
    global const uint* restrict queue,
    global const float* restrict triangles,
    global const DeviceMaterial* restrict materials,
    global const DeviceLight* restrict lights,
    global const float* restrict rays,
    global const float* restrict hits,
    global const float* restrict throughputs,
    global float* restrict radiances) {
    const uint i = (uint)get_global_id(0);
    if (i >= sizes->active) return;
    const int slot = (int)queue[i];
    const int stride = (int)params->stride;
    const int primitive = as_int(PLANE(hits, HIT_PRIMITIVE)[slot]);
    const Vec3 direction = load3(PLANE(rays, RAY_DIRECTION_X), stride, slot);
    const Interaction x = interact(
        triangles, materials, primitive, PLANE(hits, HIT_U)[slot], PLANE(hits, HIT_V)[slot], direction);
    const int emits = primitive >= 0 && max_component3(x.emission) > 0.0f;
    const float pdf_w = PLANE(throughputs, THROUGHPUT_PDF)[slot];

    // Light sampling could have chosen this point too: leave it its share (direct: all of it).
    float weight = 1.0f;
    if (SAMPLE_LIGHTS) {
        const float light_pdf_w = area_light_pdf_w(lights, x.light, PLANE(hits, HIT_T)[slot], -dot3(x.ng, direction));
        const float share = WEIGH_BOTH ? power_heuristic(pdf_w, light_pdf_w) : 0.0f;
        weight = pdf_w == PDF_CERTAIN ? 1.0f : share;
    }
    const Vec3 carried = scale3(load3(PLANE(throughputs, THROUGHPUT_R), stride, slot), weight);
    global float* radiance = PLANE(radiances, RADIANCE_R);
    const Vec3 before = load3(radiance, stride, slot);
    store3(radiance, stride, slot, select3(emits, add3(before, mul3(carried, x.emission)), before));
}
