// Embree's side of tests and benchmarks.
#pragma once

#include "prepare/embree.h"
#include "support/ray_oracle.h"

#include <memory>
#include <string>

namespace wavepath {

// The mesh, built by a device of its own. `config`: as rtcNewDevice takes it.
std::shared_ptr<RTCSceneTy> embree_scene(
    const TestMesh& mesh, const std::string& config, RTCSceneFlags flags, RTCBuildQuality quality);

// The closest hit of a ray, or, for a shadow ray, primitive 0 where anything is in its way. Inline,
// for benchmarks time it.
inline TestHit embree_trace(RTCScene scene, const TestRay& ray, bool shadow) {
    RTCRayHit query{};
    query.ray.org_x = ray.origin[0];
    query.ray.org_y = ray.origin[1];
    query.ray.org_z = ray.origin[2];
    query.ray.dir_x = ray.direction[0];
    query.ray.dir_y = ray.direction[1];
    query.ray.dir_z = ray.direction[2];
    query.ray.tfar = ray.t_max;
    query.ray.mask = ~0U;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
#if RTC_VERSION_MAJOR >= 4
    shadow ? rtcOccluded1(scene, &query.ray) : rtcIntersect1(scene, &query);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    shadow ? rtcOccluded1(scene, &context, &query.ray) : rtcIntersect1(scene, &context, &query);
#endif
    if (shadow) return {0, 0, 0, query.ray.tfar < 0 ? 0 : -1};
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {ray.t_max, 0, 0, -1};
    return {query.ray.tfar, query.hit.u, query.hit.v, static_cast<int>(query.hit.primID)};
}

}  // namespace wavepath
