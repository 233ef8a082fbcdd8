// The triangles of a scene that has few, for packets of rays (geometry/ray_packet.cl): corners that
// triangles share are listed once.
#ifndef WAVEPATH_SMALL_MESH_H
#define WAVEPATH_SMALL_MESH_H

#include "shared/cl_types.h"

#define SMALL_MESH_CORNERS 48
#define SMALL_MESH_TRIANGLES 48

typedef struct {
    shared_float corners[3][SMALL_MESH_CORNERS];     // [axis], normalised scene space
    shared_uint triangles[SMALL_MESH_TRIANGLES][3];  // rows of `corners`, in scene order
    shared_uint corner_count, triangle_count, padding[2];
} SmallMesh;
SHARED_SIZE(SmallMesh, 1168);

#endif
