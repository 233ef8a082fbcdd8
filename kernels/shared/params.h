// What is the same for every path of a window: camera, image, sample plan, limits.
#ifndef WAVEPATH_PARAMS_H
#define WAVEPATH_PARAMS_H

#include "shared/cl_types.h"

typedef struct {
    // camera: origin + direction of pixel (x, y) = corner + x * right + y * down; with
    // HAS_FAR_CAMERA what it has beside `forward`, perspective, or the origin of the pixel's ray
    shared_float camera_x, camera_y, camera_z;  // [normalised] perspective: the eye, or as far from
                                                // it as rays start
    shared_float metres;                        // one unit of the normalised scene [m]
    shared_float corner_x, corner_y, corner_z;
    shared_uint orthographic;  // 1: the corner is a point, all rays run along camera_*
    shared_float right_x, right_y, right_z;  // a pixel's step
    shared_uint seed;
    shared_float down_x, down_y, down_z;
    shared_uint stride;  // of the planes [slots]
    // image and window
    shared_uint width;  // [pixels]
    shared_uint height;
    shared_uint window_pixels;  // pixels of one pass of the window
    shared_uint first_pixel;    // of the window
    shared_uint cells;          // units of work in the window
    shared_uint pool;           // slots in use
    shared_uint pixel_step;     // pool mod window_pixels
    shared_uint pass_step;      // pool / window_pixels
    // estimator
    shared_uint max_scatterings;  // --termination depth:D, else MAX_SCATTERINGS
    shared_uint roulette;         // 0: none, 1: by throughput, 2: constant
    shared_float survival;        // [1] of constant roulette
    shared_uint splits;           // S directions from a surface point
    shared_uint split_depth;      // only the first vertices branch, and the segments before them
    shared_uint light_count;
    shared_uint material_count;
    // environment
    shared_uint environment_width;  // texels; 0: constant
    shared_uint environment_height;
    shared_float environment_r, environment_g, environment_b;  // radiance, or the scale of the map
    shared_float environment_pmf;                              // of the light choice
    shared_float environment_left;  // luminance of the map that light points leave to the bsdf
    // media
    shared_uint camera_media;  // MEDIUM_STACK at the camera
    shared_float
        ray_start;      // [normalised] from the camera to where its rays start, before the scene
    shared_uint stops;  // N stops on a segment that branches
    shared_uint stop_directions;  // M directions from a stop
    // the sphere that directions are aimed at [normalised] (lights/guide.cl)
    shared_float guide_x, guide_y, guide_z;
    shared_float guide_radius2;
    shared_float forward_x, forward_y, forward_z;  // unit, the view's axis
} RenderParams;
SHARED_SIZE(RenderParams, 196);

// One row of the sample plan: which samples of every pixel a pass takes, counted from the pixel's
// first.
typedef struct {
    shared_uint first_sample;
    shared_uint samples;
    shared_uint batch_start;   // first sample of the batch the pass belongs to
    shared_uint closes_batch;  // the batch's number of samples if this is its last pass, else 0
} PlanRow;
SHARED_SIZE(PlanRow, 16);

#endif
