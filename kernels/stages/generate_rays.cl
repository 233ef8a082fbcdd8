// Starts the next sample of every slot whose path is over: of its unit, or of the unit one pool
// further on.
//
// reads: hits, ids, plan
//
// writes: hits (a slot without work), ids, rays, throughputs, radiances, path_media
//
// One work-item a slot.

#include "geometry/path_state.cl"
#include "media/medium_stack.cl"
#include "sampling/dimensions.cl"
#include "sampling/vector.cl"
#include "shared/params.h"
#include "shared/path.h"

kernel void generate_rays(
    constant const RenderParams* restrict settings,
    const uint slots,
    global const PlanRow* restrict plan,
    global float* restrict hits,
    global uint* restrict ids,
    global float* restrict rays,
    global float* restrict throughputs,
    global float* restrict radiances,
    global float* restrict path_media) {
    const RenderParams params = *settings;
    const size_t stride = params.stride;
    const size_t slot = get_global_id(0);
    if (slot >= slots) return;
    if (hit_of(hits, stride, slot) != HIT_ENDED) return;

    // the unit and the sample
    const uint old_cell = PLANE(ids, ID_CELL)[slot];
    const uint old_pixel = PLANE(ids, ID_PIXEL)[slot];
    const uint old_pass = PLANE(ids, ID_PASS)[slot];
    const uint old_left = PLANE(ids, ID_LEFT)[slot];
    const int same_unit = old_left > 0;
    const uint cell = same_unit ? old_cell : old_cell + params.pool;
    if (cell >= params.cells) {
        set_hit(hits, stride, slot, HIT_IDLE);
        return;
    }
    uint pixel = old_pixel;
    uint pass = old_pass;
    uint left = old_left - 1;
    uint sample = PLANE(ids, ID_SAMPLE)[slot] + 1;
    uint seed = PLANE(ids, ID_SEED)[slot];
    uint index = reverse_bits_32(reverse_bits_32(PLANE(ids, ID_INDEX)[slot]) + 1);
    if (!same_unit) {
        const uint stepped = old_pixel - params.first_pixel + params.pixel_step;
        const uint wrapped = stepped >= params.window_pixels;
        pixel = params.first_pixel + stepped - (wrapped ? params.window_pixels : 0);
        pass = old_pass + params.pass_step + wrapped;
        left = plan[(int)pass].samples - 1;
        sample = 0;
        seed = hash_pair(params.seed, pixel);
        index = reverse_bits_32(plan[(int)pass].first_sample);
    }
    PLANE(ids, ID_CELL)[slot] = cell;
    PLANE(ids, ID_PIXEL)[slot] = pixel;
    PLANE(ids, ID_PASS)[slot] = pass;
    PLANE(ids, ID_SAMPLE)[slot] = sample;
    PLANE(ids, ID_LEFT)[slot] = left;
    PLANE(ids, ID_SEED)[slot] = seed;
    PLANE(ids, ID_INDEX)[slot] = index;
    PLANE(ids, ID_SCATTERING)[slot] = 0;
    if (HAS_SPLITS) {
        PLANE(ids, ID_BRANCH)[slot] = 0;
        PLANE(ids, ID_STACK)[slot] = 0;
        PLANE(ids, ID_SHARES)[slot] = as_uint(1.0f);
        PLANE(hits, HIT_T)[slot] = 0.0f;
    }

    // the ray through a point of the pixel, uniform: one box filter
    const Sample2 jitter = unit_pair(dimension_pair(seed, index, PAIR_PIXEL, 1));
    // exact below 2^24 pixels a side; a float quotient may be off by one, hence the correction
    const uint width = params.width;
    const uint guess = (uint)((float)pixel / (float)width);
    const uint below = guess * width > pixel ? guess - 1 : guess;
    const uint row = pixel - below * width >= width ? below + 1 : below;
    const float x = (float)(pixel - row * width) + jitter.u;
    const float y = (float)row + jitter.v;
    const Vec3 corner = vec3(params.corner_x, params.corner_y, params.corner_z);
    const Vec3 right = vec3(params.right_x, params.right_y, params.right_z);
    const Vec3 down = vec3(params.down_x, params.down_y, params.down_z);
    const Vec3 camera = vec3(params.camera_x, params.camera_y, params.camera_z);
    const Vec3 film = madd3(madd3(corner, right, x), down, y);
    const int orthographic = params.orthographic != 0;
    Vec3 direction = select3(orthographic, camera, normalize3(film));
    Vec3 origin = select3(orthographic, film, camera);
    if (HAS_FAR_CAMERA) {
        // `camera` is where the view's axis has run ray_start. The ray's is beside it by a vector
        // that is free of cancellation: cosine - 1 = -sine^2 / (1 + cosine).
        const float tangent2 = dot3(film, film);
        const float cosine = 1.0f / sqrt(1.0f + tangent2);
        const float sine2 = tangent2 * cosine * cosine;
        const Vec3 forward = vec3(params.forward_x, params.forward_y, params.forward_z);
        const Vec3 beside = madd3(scale3(film, cosine), forward, -sine2 / (1.0f + cosine));
        direction = select3(orthographic, camera, add3(forward, beside));
        origin = select3(orthographic, film, madd3(camera, beside, params.ray_start));
    } else if (HAS_MEDIA | HAS_CONTACTS) {
        // from far off rounding of distances would decide what touches
        origin = madd3(origin, direction, params.ray_start);
    }
    store3(PLANE(rays, RAY_ORIGIN_X), stride, slot, origin);
    store3(PLANE(rays, RAY_DIRECTION_X), stride, slot, direction);

    store3(PLANE(throughputs, THROUGHPUT_R), stride, slot, vec3(1.0f, 1.0f, 1.0f));
    PLANE(throughputs, THROUGHPUT_PDF)[slot] = PDF_CERTAIN;
    store3(PLANE(radiances, RADIANCE_R), stride, slot, vec3(0.0f, 0.0f, 0.0f));
    if (HAS_PASSAGES) {
        PLANE(path_media, MEDIUM_STACK)[slot] = as_float(params.camera_media);
        start_at_origin(path_media, stride, slot);
    }
}
