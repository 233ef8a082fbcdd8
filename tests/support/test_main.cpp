// gtest's main, with the door through which list_devices() starts this program as its child.
#include "device/device.h"
#include "device/device_probe.h"

#include <gtest/gtest.h>

int main(int argc, char** argv) {
    if (wavepath::run_device_probe(argc, argv)) return 0;
    wavepath::prepare_environment();
    testing::InitGoogleTest(&argc, argv);
    return RUN_ALL_TESTS();
}
