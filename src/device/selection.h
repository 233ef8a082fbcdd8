// Which device a selector means.
#pragma once

#include "device/device.h"

#include <cstddef>
#include <string>
#include <vector>

namespace wavepath {

// The entry of `devices` that `selector` (see open_device) means: the first usable one that fits.
// Throws Error where none fits, with the list, or where all that fit are unusable, with the first
// one's reason.
std::size_t select_device(const std::vector<DeviceInfo>& devices, const std::string& selector);

// "0.1 NVIDIA CUDA, NVIDIA H100"; of a platform without devices "2 rusticl".
std::string device_label(const DeviceInfo& device);

bool is_pocl(const DeviceInfo& device);

}  // namespace wavepath
