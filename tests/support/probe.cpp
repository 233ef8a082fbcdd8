#include "support/probe.h"

#include "device/program.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace wavepath {

namespace {

constexpr std::size_t work_group = 64;  // every device allows it

}  // namespace

const Device& test_device() {
    // Never released: a driver may be gone by the time static objects are (oclgrind's is).
    static const Device& device = *new Device([] {
        const char* selector = std::getenv("WAVEPATH_TEST_DEVICE");
        return open_device(selector != nullptr ? selector : "");
    }());
    return device;
}

double test_scale() {
    const char* scale = std::getenv("WAVEPATH_TEST_SCALE");
    return scale != nullptr ? std::atof(scale) : 1.0;
}

std::size_t scaled(std::size_t samples) {
    return static_cast<std::size_t>(
        std::max(1.0, std::round(static_cast<double>(samples) * test_scale())));
}

Probe::Probe(
    const std::vector<std::string>& files, const std::string& text, const std::string& defines)
    : program_(build_program(
          test_device(), assemble_source(defines, files) + "#line 1 \"probe\"\n" + text)) {}

void Probe::launch(const cl::Kernel& kernel, std::size_t items) {
    const std::size_t rounded = (items + work_group - 1) / work_group * work_group;
    const cl::CommandQueue& queue = test_device().queue;
    queue.enqueueNDRangeKernel(
        kernel, cl::NullRange, cl::NDRange(rounded), cl::NDRange(work_group));
    queue.finish();
}

}  // namespace wavepath
