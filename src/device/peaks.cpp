#include "device/peaks.h"

#include "device/device_array.h"
#include "device/program.h"
#include "shared/peaks.h"
#include "stopwatch.h"

namespace wavepath {

namespace {

constexpr std::size_t group = 256;
// Of a go: far more than a launch costs, and less than the time slice of another process.
constexpr double go_seconds = 0.002;
constexpr int goes = 30;
constexpr int fewest_goes = 4;
constexpr double most_seconds = 0.3;  // in all, where goes are long and there were that many

// Launches a second, of the best of many goes.
double best_rate(const Device& device, const cl::Kernel& kernel, std::size_t items) {
    double best = 0;
    double spent = 0;
    int launches = 1;
    Stopwatch watch;
    for (int go = 0; go < goes && (go < fewest_goes || spent < most_seconds); ++go) {
        watch.lap();
        for (int i = 0; i < launches; ++i)
            device.queue.enqueueNDRangeKernel(
                kernel, cl::NullRange, cl::NDRange(items), cl::NDRange(group));
        device.queue.finish();
        const double seconds = watch.lap();
        spent += seconds;
        if (go > 0) best = std::max(best, launches / seconds);  // PoCL compiles at the first
        if (seconds < go_seconds) launches *= 2;
    }
    return best;
}

DeviceArray<cl_float> zeros(const Device& device, std::size_t count) {
    DeviceArray<cl_float> array(device, count, "the peaks of the device");
    device.queue.enqueueFillBuffer(array.buffer(), cl_float{0}, 0, array.bytes());
    return array;
}

double bytes_per_s(const Device& device) {
    const uint64_t cache = device.device.getInfo<CL_DEVICE_GLOBAL_MEM_CACHE_SIZE>();
    const uint64_t bytes = std::min(
        {std::max<uint64_t>(2 * cache, uint64_t{32} << 20U), device.info.max_allocation,
         device.info.global_memory / 8});
    const std::size_t items = bytes / sizeof(cl_float) / group * group;
    const auto a = zeros(device, items);
    const auto b = zeros(device, items);
    const auto c = zeros(device, items);
    const cl::Program program = build_program(device, assemble_source("", {"peaks/triad.cl"}));
    cl::Kernel kernel(program, "triad");
    kernel.setArg(0, cl_float{0.5F});
    kernel.setArg(1, b.buffer());
    kernel.setArg(2, c.buffer());
    kernel.setArg(3, a.buffer());
    return best_rate(device, kernel, items) * static_cast<double>(items * 3 * sizeof(cl_float));
}

double flops_per_s(const Device& device, int width) {
    const std::size_t items = group * 4 * device.info.compute_units;
    const auto sums = zeros(device, items * static_cast<std::size_t>(width));
    const std::string defines = fmt::format("#define WIDTH {}\n", width);
    const cl::Program program =
        build_program(device, assemble_source(defines, {"peaks/fma_chains.cl"}));
    cl::Kernel kernel(program, "fma_chains");
    kernel.setArg(0, cl_float{0.5F});
    kernel.setArg(1, cl_float{1.0F});
    kernel.setArg(2, sums.buffer());
    return best_rate(device, kernel, items) * static_cast<double>(items) * 2 * width * FMA_CHAINS *
           FMA_STEPS;
}

}  // namespace

Peaks measure_peaks(const Device& device) {
    Peaks peaks;
    peaks.bytes_per_s = bytes_per_s(device);
    for (const int width : {1, 4, 8, 16}) {
        const double rate = flops_per_s(device, width);
        if (rate <= peaks.flops_per_s) continue;
        peaks.flops_per_s = rate;
        peaks.vector_width = width;
    }
    return peaks;
}

}  // namespace wavepath
