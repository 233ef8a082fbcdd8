// Our traversal kernels on a CPU device against Embree's rtcIntersect1 and rtcOccluded1 (fast mode,
// high build quality): the same triangles, rays and cores, interleaved. Prints a table of ratios,
// above 1 where we are faster.
//
//     traversal_bench [--pairs N] [--embree CONFIG] [--cpu-time]
//
// --embree: a device configuration; Embree 3 chooses 4-wide trees on Xeons, frequency_level=simd256
// makes them 8-wide.
// --cpu-time: compares processor time, for machines that others use at the same time.
#include "bench/workloads.h"
#include "device/device_array.h"
#include "device/device_probe.h"
#include "device/program.h"
#include "prepare/bvh_builder.h"
#include "support/embree_scene.h"
#include "wavefront/features.h"

#include <fmt/format.h>
#include <pthread.h>
#ifdef __SSE__
#include <xmmintrin.h>
#endif

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <ctime>
#include <memory>
#include <string>
#include <thread>

namespace wavepath {
namespace {

constexpr const char* kernels = R"(
INLINE void stream_rays(
    const uint count, global const float* rays, global const BvhNode* nodes,
    global const TriangleBlock* blocks, global Hit* hits, uint i, const int any) {
    const uint end = min(count, i + RAYS_PER_ITEM);
    const Cover cover = full_cover();
    RayStream stream;
    stream_open(&stream);
    do {
        for (; i < end && stream_has_room(&stream); ++i) {
            global const float* r = rays + 8 * i;
            const Ray ray = make_ray(vec3(r[0], r[1], r[2]), vec3(r[3], r[4], r[5]), r[6]);
            stream_add(&stream, i, &ray, at_origin(), 0);
        }
        stream_step(&stream, make_tree(nodes, blocks), &cover, any);
        for (int k = 0; k < stream.ended; ++k) {
            const StreamRay* ray = stream_ended(&stream, k);
            if (any)
                hits[ray->item].primitive = ray->hit.primitive;
            else
                hits[ray->item] = ray->hit;
        }
    } while (i < end || stream_busy(&stream));
}

kernel void closest(
    const uint count, global const float* rays, global const BvhNode* nodes,
    global const TriangleBlock* blocks, global Hit* hits) {
    const uint i = (uint)get_global_id(0) * RAYS_PER_ITEM;
    if (i >= count) return;
    if (RAYS_PER_ITEM == 1) {
        global const float* r = rays + 8 * i;
        const Ray ray = make_ray(vec3(r[0], r[1], r[2]), vec3(r[3], r[4], r[5]), r[6]);
        hits[i] = closest_hit(make_tree(nodes, blocks), &ray, at_origin(), 0);
        return;
    }
    stream_rays(count, rays, nodes, blocks, hits, i, 0);
}

kernel void blocked(
    const uint count, global const float* rays, global const BvhNode* nodes,
    global const TriangleBlock* blocks, global Hit* hits) {
    const uint i = (uint)get_global_id(0) * RAYS_PER_ITEM;
    if (i >= count) return;
    if (RAYS_PER_ITEM == 1) {
        global const float* r = rays + 8 * i;
        const Ray ray = make_ray(vec3(r[0], r[1], r[2]), vec3(r[3], r[4], r[5]), r[6]);
        hits[i].primitive = any_hit(make_tree(nodes, blocks), &ray, 0) - 1;
        return;
    }
    stream_rays(count, rays, nodes, blocks, hits, i, 1);
}
)";

bool cpu_time = false;

double seconds() {
    if (!cpu_time)
        return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
            .count();
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

class EmbreeScene {
  public:
    EmbreeScene(const TestMesh& mesh, const std::string& config)
        : scene_(embree_scene(mesh, config, RTC_SCENE_FLAG_NONE, RTC_BUILD_QUALITY_HIGH)) {}

    // On every CPU, a thread pinned to each, in chunks of 1024 rays.
    void trace(const std::vector<TestRay>& rays, bool shadow, std::vector<TestHit>& hits) const {
        std::atomic<std::size_t> next{0};
        const auto work = [&](unsigned cpu) {
            cpu_set_t set;
            CPU_ZERO(&set);
            CPU_SET(cpu, &set);
            pthread_setaffinity_np(pthread_self(), sizeof set, &set);
#ifdef __SSE__
            _mm_setcsr(_mm_getcsr() | 0x8040U);  // denormals are zero, as Embree asks for
#endif
            for (std::size_t i = next.fetch_add(chunk); i < rays.size(); i = next.fetch_add(chunk))
                for (std::size_t k = i; k < std::min(rays.size(), i + chunk); ++k)
                    hits[k] = embree_trace(scene_.get(), rays[k], shadow);
        };
        std::vector<std::thread> threads;
        for (unsigned cpu = 0; cpu < std::thread::hardware_concurrency(); ++cpu)
            threads.emplace_back(work, cpu);
        for (std::thread& thread : threads) thread.join();
    }

  private:
    static constexpr std::size_t chunk = 1024;

    std::shared_ptr<RTCSceneTy> scene_;
};

// A way to launch our kernels: each ray on its own, or a stream of many in a work-item.
struct Launch {
    cl::Program program;
    std::size_t rays_per_item, local_size;

    void run(
        const Device& device, const RaySet& set, const std::vector<cl::Buffer>& buffers) const {
        cl::Kernel kernel(program, set.shadow ? "blocked" : "closest");
        kernel.setArg(0, static_cast<cl_uint>(set.rays.size()));
        for (cl_uint i = 0; i < buffers.size(); ++i) kernel.setArg(i + 1, buffers[i]);
        const std::size_t items = (set.rays.size() + rays_per_item - 1) / rays_per_item;
        const std::size_t groups = (items + local_size - 1) / local_size;
        device.queue.enqueueNDRangeKernel(
            kernel, cl::NullRange, cl::NDRange(groups * local_size), cl::NDRange(local_size));
        device.queue.finish();
    }
};

Launch make_launch(const Device& device, std::size_t rays_per_item, std::size_t local_size) {
    const std::string source =
        assemble_source(
            fmt::format("#define RAYS_PER_ITEM {}\n", rays_per_item), {"geometry/ray_stream.cl"}) +
        kernels;
    return {build_program(device, source), rays_per_item, local_size};
}

// Median and its 95 % interval, by ranks.
std::string summary(std::vector<double> ratios) {
    std::sort(ratios.begin(), ratios.end());
    const auto n = static_cast<double>(ratios.size());
    const auto rank =
        static_cast<std::size_t>(std::max(0.0, std::floor(n / 2 - 0.98 * std::sqrt(n))));
    return fmt::format(
        "{:.2f} [{:.2f} {:.2f}]", ratios[ratios.size() / 2], ratios[rank],
        ratios[ratios.size() - 1 - rank]);
}

std::size_t differing(const std::vector<TestHit>& a, const std::vector<TestHit>& b) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        count += (a[i].primitive < 0) != (b[i].primitive < 0) ? 1 : 0;
    return count;
}

void measure(
    const Device& device, const Workload& workload, const std::string& config, std::size_t pairs) {
    const EmbreeScene embree(workload.mesh, config);
    const Bvh bvh = build_bvh(workload.mesh.positions);
    fmt::print(
        "{}, {} triangles, tree {:.1f} MB, built in {:.2f} s\n", workload.mesh.name,
        workload.mesh.size(),
        static_cast<double>(
            bvh.nodes.size() * sizeof(BvhNode) + bvh.blocks.size() * sizeof(TriangleBlock)) /
            1e6,
        bvh.build_seconds);
    const DeviceArray<BvhNode> nodes(device, bvh.nodes, "nodes");
    const DeviceArray<TriangleBlock> blocks(device, bvh.blocks, "blocks");
    const std::array launches{make_launch(device, 1, 64), make_launch(device, stream_rays, 1)};
    const std::vector<RaySet> sets =
        make_ray_sets(workload, 512, [&](const std::vector<TestRay>& rays) {
            std::vector<TestHit> hits(rays.size());
            embree.trace(rays, false, hits);
            return hits;
        });
    for (const RaySet& set : sets) {
        const DeviceArray<TestRay> rays(device, set.rays, "rays");
        const DeviceArray<TestHit> hits(device, set.rays.size(), "hits");
        std::vector<TestHit> theirs(set.rays.size());
        std::array<std::vector<double>, 2> ratios;
        double fastest = 1e30;
        std::size_t apart = 0;
        for (std::size_t pair = 0; pair <= pairs; ++pair) {  // the first warms up
            const double start = seconds();
            embree.trace(set.rays, set.shadow, theirs);
            const double embree_time = seconds() - start;
            for (std::size_t k = 0; k < launches.size(); ++k) {
                const double before = seconds();
                launches[k].run(
                    device, set, {rays.buffer(), nodes.buffer(), blocks.buffer(), hits.buffer()});
                if (pair > 0) ratios[k].push_back(embree_time / (seconds() - before));
                if (pair == 0) apart = std::max(apart, differing(hits.read(device), theirs));
            }
            if (pair > 0) fastest = std::min(fastest, embree_time);
        }
        const double cores = cpu_time ? std::thread::hardware_concurrency() : 1;
        fmt::print(
            "  {:9} {:7} rays, Embree {:6.2f} Mray/s; alone {}, stream {}; {} hit or miss "
            "otherwise\n",
            set.name, set.rays.size(), cores * static_cast<double>(set.rays.size()) / fastest / 1e6,
            summary(ratios[0]), summary(ratios[1]), apart);
    }
}

}  // namespace
}  // namespace wavepath

int main(int argc, char** argv) {
    using namespace wavepath;
    if (run_device_probe(argc, argv)) return 0;  // list_devices() starts this program as its child
    std::size_t pairs = 15;
    std::string config;
    for (int i = 1; i < argc; ++i) {
        const std::string option = argv[i];
        if (option == "--cpu-time") cpu_time = true;
        if (option == "--pairs" && i + 1 < argc) pairs = std::stoul(argv[i + 1]);
        if (option == "--embree" && i + 1 < argc) config = argv[i + 1];
    }
    prepare_environment();
    try {
        const Device device = open_device("");
        for (const Workload& workload :
             {terrain_workload(224), spheres_workload(400, 11), terrain_workload(707),
              spheres_workload(1000, 22)})
            measure(device, workload, config, pairs);
    } catch (const std::exception& error) {
        fmt::print(stderr, "error: {}\n", error.what());
        return 1;
    }
    return 0;
}
