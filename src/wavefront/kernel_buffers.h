// Buffers under the names that kernels use for them.
#pragma once

#include "device/device_array.h"
#include "device/kernel_signature.h"
#include "shared/bvh.h"
#include "shared/params.h"
#include "shared/queues.h"
#include "shared/scene.h"
#include "shared/small_mesh.h"
#include "shared/texture.h"

#include <map>
#include <string>
#include <string_view>

namespace wavepath {

// What kernels call the type of an element.
template <typename T>
constexpr std::string_view kernel_type = T::no_type_of_kernels;
template <>
inline constexpr std::string_view kernel_type<cl_float> = "float";
template <>
inline constexpr std::string_view kernel_type<cl_uint> = "uint";
template <>
inline constexpr std::string_view kernel_type<cl_uchar> = "uchar";
template <>
inline constexpr std::string_view kernel_type<RenderParams> = "RenderParams";
template <>
inline constexpr std::string_view kernel_type<PlanRow> = "PlanRow";
template <>
inline constexpr std::string_view kernel_type<ChunkState> = "ChunkState";
template <>
inline constexpr std::string_view kernel_type<BvhNode> = "BvhNode";
template <>
inline constexpr std::string_view kernel_type<TriangleBlock> = "TriangleBlock";
template <>
inline constexpr std::string_view kernel_type<SmallMesh> = "SmallMesh";
template <>
inline constexpr std::string_view kernel_type<DeviceMaterial> = "DeviceMaterial";
template <>
inline constexpr std::string_view kernel_type<DeviceTexture> = "DeviceTexture";
template <>
inline constexpr std::string_view kernel_type<DeviceLight> = "DeviceLight";
template <>
inline constexpr std::string_view kernel_type<DeviceMedium> = "DeviceMedium";
template <>
inline constexpr std::string_view kernel_type<EnvironmentEntry> = "EnvironmentEntry";

enum class Access { read, write };

class KernelBuffers {
  public:
    // `access`: whether kernels may write it.
    template <typename T>
    void add(const std::string& name, const DeviceArray<T>& array, Access access) {
        entries_[name] = {std::string(kernel_type<T>), access, array.bytes(), array.buffer()};
    }

    bool has(const std::string& name) const { return entries_.contains(name); }
    // Of all together.
    std::size_t bytes() const;

    // The buffer of a parameter of this kernel. Throws Error, naming both, where there is none of
    // this name, where its elements are of another type, or where the kernel writes what it may
    // not.
    const cl::Buffer& of(const std::string& kernel, const KernelParameter& parameter) const;

  private:
    struct Entry {  // NOLINT(bugprone-exception-escape): see Device
        std::string type;
        Access access = Access::read;
        std::size_t bytes = 0;
        cl::Buffer buffer;
    };

    std::map<std::string, Entry> entries_;
};

}  // namespace wavepath
