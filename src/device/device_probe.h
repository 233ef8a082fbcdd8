// Lists the devices without trusting any driver.
#pragma once

#include "device/device.h"

#include <chrono>
#include <vector>

namespace wavepath {

// Every device of every platform, found by a child process for each platform so that a driver that
// crashes or hangs takes down nothing but its own rows; the child runs a kernel on each device. A
// platform without devices, or a driver that fails, is a row with `unusable`. Needs
// run_device_probe() in the program's main.
std::vector<DeviceInfo> list_devices(std::chrono::seconds limit = std::chrono::seconds(20));

// To be called first in main: where this process is a child of list_devices(), does its work and
// returns true; main then returns at once.
bool run_device_probe(int argc, char** argv);

}  // namespace wavepath
