// Structs of kernels/shared/ lie in memory alike on both sides of the bus.
#include "shared/bvh.h"
#include "shared/params.h"
#include "shared/queues.h"
#include "shared/scene.h"
#include "shared/small_mesh.h"
#include "shared/texture.h"
#include "support/probe.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <vector>

namespace wavepath {
namespace {

// Every field of every shared struct, in order: STRUCT(type) opens one, FIELD(type, name) follows.
// clang-format off
#define SHARED_LAYOUT(STRUCT, FIELD)                                                              \
    STRUCT(BvhNode)                                                                               \
    FIELD(BvhNode, bounds) FIELD(BvhNode, children)                                               \
    STRUCT(TriangleBlock)                                                                         \
    FIELD(TriangleBlock, vertices) FIELD(TriangleBlock, primitives)                               \
    STRUCT(SmallMesh)                                                                             \
    FIELD(SmallMesh, corners) FIELD(SmallMesh, triangles) FIELD(SmallMesh, corner_count)          \
    FIELD(SmallMesh, triangle_count) FIELD(SmallMesh, padding)                                    \
    STRUCT(DeviceMaterial)                                                                        \
    FIELD(DeviceMaterial, base_r) FIELD(DeviceMaterial, f0_r) FIELD(DeviceMaterial, emission_r)   \
    FIELD(DeviceMaterial, metallic) FIELD(DeviceMaterial, base_g) FIELD(DeviceMaterial, f0_g)     \
    FIELD(DeviceMaterial, emission_g) FIELD(DeviceMaterial, specular)                             \
    FIELD(DeviceMaterial, base_b) FIELD(DeviceMaterial, f0_b) FIELD(DeviceMaterial, emission_b)   \
    FIELD(DeviceMaterial, alpha) FIELD(DeviceMaterial, double_sided)                              \
    FIELD(DeviceMaterial, boundary) FIELD(DeviceMaterial, medium)                                 \
    FIELD(DeviceMaterial, transmission)                                                           \
    STRUCT(DeviceMedium)                                                                          \
    FIELD(DeviceMedium, sigma_t_r) FIELD(DeviceMedium, sigma_s_r)                                 \
    FIELD(DeviceMedium, emission_r) FIELD(DeviceMedium, anisotropy)                               \
    FIELD(DeviceMedium, sigma_t_g) FIELD(DeviceMedium, sigma_s_g)                                 \
    FIELD(DeviceMedium, emission_g) FIELD(DeviceMedium, ior)                                      \
    FIELD(DeviceMedium, sigma_t_b) FIELD(DeviceMedium, sigma_s_b)                                 \
    FIELD(DeviceMedium, emission_b) FIELD(DeviceMedium, padding)                                  \
    STRUCT(DeviceLight)                                                                           \
    FIELD(DeviceLight, alias_threshold) FIELD(DeviceLight, alias) FIELD(DeviceLight, pmf)         \
    FIELD(DeviceLight, kind) FIELD(DeviceLight, primitive) FIELD(DeviceLight, area)               \
    FIELD(DeviceLight, range) FIELD(DeviceLight, spot_outer) FIELD(DeviceLight, spot_scale)      \
    FIELD(DeviceLight, double_sided) FIELD(DeviceLight, intensity_r)                              \
    FIELD(DeviceLight, position_x) FIELD(DeviceLight, direction_x)                                \
    FIELD(DeviceLight, intensity_g) FIELD(DeviceLight, position_y)                                \
    FIELD(DeviceLight, direction_y) FIELD(DeviceLight, intensity_b)                               \
    FIELD(DeviceLight, position_z) FIELD(DeviceLight, direction_z) FIELD(DeviceLight, padding2)   \
    STRUCT(EnvironmentEntry)                                                                      \
    FIELD(EnvironmentEntry, alias_threshold) FIELD(EnvironmentEntry, alias)                       \
    FIELD(EnvironmentEntry, pmf) FIELD(EnvironmentEntry, r)      \
    FIELD(EnvironmentEntry, g) FIELD(EnvironmentEntry, b)       \
    STRUCT(RenderParams)                                                                          \
    FIELD(RenderParams, camera_x) FIELD(RenderParams, camera_y) FIELD(RenderParams, camera_z)     \
    FIELD(RenderParams, metres) FIELD(RenderParams, corner_x) FIELD(RenderParams, corner_y)       \
    FIELD(RenderParams, corner_z) FIELD(RenderParams, orthographic) FIELD(RenderParams, right_x)  \
    FIELD(RenderParams, right_y) FIELD(RenderParams, right_z) FIELD(RenderParams, seed)           \
    FIELD(RenderParams, down_x) FIELD(RenderParams, down_y) FIELD(RenderParams, down_z)           \
    FIELD(RenderParams, stride) FIELD(RenderParams, width) FIELD(RenderParams, height)            \
    FIELD(RenderParams, window_pixels) FIELD(RenderParams, first_pixel)                           \
    FIELD(RenderParams, cells) FIELD(RenderParams, pool) FIELD(RenderParams, pixel_step)          \
    FIELD(RenderParams, pass_step) FIELD(RenderParams, max_scatterings)                           \
    FIELD(RenderParams, roulette) FIELD(RenderParams, survival) FIELD(RenderParams, splits)       \
    FIELD(RenderParams, split_depth) FIELD(RenderParams, light_count)                             \
    FIELD(RenderParams, material_count)                                                           \
    FIELD(RenderParams, environment_width) FIELD(RenderParams, environment_height)                \
    FIELD(RenderParams, environment_r) FIELD(RenderParams, environment_g)                         \
    FIELD(RenderParams, environment_b) FIELD(RenderParams, environment_pmf)  FIELD(RenderParams, environment_left)                     \
    FIELD(RenderParams, camera_media) FIELD(RenderParams, ray_start) FIELD(RenderParams, stops)                                  \
    FIELD(RenderParams, stop_directions) \
    FIELD(RenderParams, guide_x) FIELD(RenderParams, guide_y) FIELD(RenderParams, guide_z)        \
    FIELD(RenderParams, guide_radius2) FIELD(RenderParams, forward_x)                             \
    FIELD(RenderParams, forward_y) FIELD(RenderParams, forward_z)                                 \
    STRUCT(PlanRow)                                                                               \
    FIELD(PlanRow, first_sample) FIELD(PlanRow, samples) FIELD(PlanRow, batch_start)              \
    FIELD(PlanRow, closes_batch)                                                                  \
    STRUCT(DeviceTexture)                                                                         \
    FIELD(DeviceTexture, first_word) FIELD(DeviceTexture, width) FIELD(DeviceTexture, height)     \
    FIELD(DeviceTexture, flags) FIELD(DeviceTexture, s_u) FIELD(DeviceTexture, s_v)               \
    FIELD(DeviceTexture, s_1) FIELD(DeviceTexture, t_u) FIELD(DeviceTexture, t_v)                 \
    FIELD(DeviceTexture, t_1) FIELD(DeviceTexture, scale) FIELD(DeviceTexture, cutoff)            \
    STRUCT(ChunkState)                                                                            \
    FIELD(ChunkState, active) FIELD(ChunkState, resumed) FIELD(ChunkState, cut)                    \
    FIELD(ChunkState, cut_pixel) FIELD(ChunkState, cut_sample)
// clang-format on

// A row of the table as one side sees it: where a field begins, or a struct ends.
struct Row {
    std::string name;
    std::size_t place;      // offset of the field, size of the struct
    std::size_t bytes = 0;  // of the field; 0: a struct
};

#define HOST_STRUCT(type) Row{#type, sizeof(type), 0},
#define HOST_FIELD(type, name) Row{#type "." #name, offsetof(type, name), sizeof(type::name)},
const std::vector<Row> host_layout{SHARED_LAYOUT(HOST_STRUCT, HOST_FIELD)};

#define DEVICE_STRUCT(type) "out[k++] = (uint)sizeof(" #type ");\n"
#define DEVICE_FIELD(type, name) \
    "{ " #type " s; out[k++] = (uint)((size_t)&s." #name " - (size_t)&s); }\n"
const std::string device_layout =
    "kernel void layout(const uint count, global uint* out) {\n"
    "if (get_global_id(0) >= count) return;\n"
    "int k = 0;\n" SHARED_LAYOUT(DEVICE_STRUCT, DEVICE_FIELD) "}\n";

TEST(Layout, HostAndDeviceAgree) {
    const Probe probe(
        {"shared/bvh.h", "shared/params.h", "shared/queues.h", "shared/scene.h",
         "shared/small_mesh.h", "shared/texture.h"},
        device_layout);
    const auto places = probe.run<cl_uint>("layout", 1, host_layout.size());
    for (std::size_t k = 0; k < places.size(); ++k)
        EXPECT_EQ(places[k], host_layout[k].place) << host_layout[k].name;
}

// Otherwise a field that somebody adds would go unchecked.
TEST(Layout, TableHoldsEveryField) {
    std::size_t end = 0;
    std::size_t size = 0;
    for (const Row& row : host_layout) {
        if (row.bytes == 0) {
            EXPECT_EQ(end, size) << "before " << row.name << ": SHARED_LAYOUT lacks a field";
            size = row.place;
            end = 0;
        } else {
            EXPECT_EQ(row.place, end) << row.name << ": SHARED_LAYOUT lacks a field before it";
            end += row.bytes;
        }
    }
    EXPECT_EQ(end, size);
}

}  // namespace
}  // namespace wavepath
