// A DeviceInfo as JSON: the fields' names are the keys of `wavepath devices --json`
// (docs/devices.md).
#pragma once

#include "device/device.h"

#include <nlohmann/json.hpp>

namespace wavepath {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(
    DeviceInfo,
    platform_index,
    device_index,
    platform,
    name,
    vendor,
    version,
    driver,
    is_cpu,
    is_gpu,
    compute_units,
    global_memory,
    max_allocation,
    max_work_group,
    correctly_rounded,
    unusable,
    default_pool)

}  // namespace wavepath
