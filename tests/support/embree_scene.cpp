#include "support/embree_scene.h"

#include <cstring>

namespace wavepath {

std::shared_ptr<RTCSceneTy> embree_scene(
    const TestMesh& mesh, const std::string& config, RTCSceneFlags flags, RTCBuildQuality quality) {
    const std::shared_ptr<RTCDeviceTy> device(rtcNewDevice(config.c_str()), rtcReleaseDevice);
    std::shared_ptr<RTCSceneTy> scene(rtcNewScene(device.get()), rtcReleaseScene);
    rtcSetSceneFlags(scene.get(), flags);
    rtcSetSceneBuildQuality(scene.get(), quality);
    RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetGeometryBuildQuality(geometry, quality);
    void* vertices = rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, 3 * mesh.size());
    std::memcpy(vertices, mesh.positions.data(), mesh.positions.size() * sizeof(float));
    auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, mesh.size()));
    for (unsigned i = 0; i < 3 * mesh.size(); ++i) indices[i] = i;
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene.get());
    return scene;
}

}  // namespace wavepath
