// The same command gives the same bits, however the work is divided.
#include "build_paths.h"
#include "shared/small_mesh.h"
#include "support/environment_variable.h"
#include "support/partial_boundaries.h"
#include "support/rendering.h"
#include "support/temporary_folder.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>

namespace wavepath {
namespace {

Scene room() {
    Scene scene = scene_named("room");
    add_box(scene, lambert({0.7F, 0.5F, 0.4F}), {-1, -1, -1}, {1, 1, 1}, Facing::inward);
    add_square(scene, lambert(grey(0), grey(6)), {0, 0.9, 0}, {0, -1, 0}, 0.8);
    add_box(scene, metal(grey(0.8F), 0.4F), {-0.5, -0.8, -0.5}, {0.1, 0, 0.2}, Facing::outward);
    return scene;
}

// 37 x 23 pixels of 13 samples: nothing divides evenly.
RenderSettings uneven() {
    RenderSettings settings =
        square_settings("mis", perspective({0.8, 0.2, 0.9}, {-0.2, -0.4, -0.3}, 1.2), 37, 13);
    settings.height = 23;
    return settings;
}

void expect_same_bits(const RenderResult& a, const RenderResult& b) {
    for (const auto& [name, plane] : a.film.image.channels) {
        const std::vector<float>& other = b.film.image.channels.at(name);
        ASSERT_EQ(plane.size(), other.size());
        EXPECT_EQ(std::memcmp(plane.data(), other.data(), plane.size() * sizeof(float)), 0) << name;
    }
}

TEST(Determinism, OfTwoRunsPoolsAndWorkGroups) {
    const RenderResult first = render_scene(room(), uneven());
    expect_same_bits(first, render_scene(room(), uneven()));
    for (const uint32_t pool : {1U, 17U, 1000U, 65280U, 200000U}) {
        SCOPED_TRACE(fmt::format("pool {}", pool));
        RenderSettings settings = uneven();
        settings.pool = pool;
        // one slot takes a launch a ray: a corner of the picture will do
        if (pool == 1) settings.samples = 1;
        RenderSettings reference = uneven();
        reference.samples = settings.samples;
        expect_same_bits(render_scene(room(), reference), render_scene(room(), settings));
    }
    RenderSettings settings = uneven();
    settings.work_groups = {16, 64};
    SCOPED_TRACE("work-groups 16, 64");
    expect_same_bits(first, render_scene(room(), settings));
}

// As on a GPU: launches are bounds, and compaction works from old counts.
TEST(Determinism, OfCountsThatComeLate) {
    for (const uint32_t splits : {1U, 3U}) {
        RenderSettings settings = uneven();
        settings.samples = 4;
        settings.splits.reflections = splits;
        settings.pool = 1000;
        const RenderResult exact = render_scene(room(), settings);
        for (const uint32_t lag : {1U, 2U}) {
            SCOPED_TRACE(fmt::format("{} splits, counts {} iterations late", splits, lag));
            settings.count_lag = lag;
            const RenderResult late = render_scene(room(), settings);
            expect_same_bits(exact, late);
            EXPECT_EQ(exact.rays.closest, late.rays.closest);
            EXPECT_EQ(exact.rays.connections, late.rays.connections);
            EXPECT_EQ(exact.rays.path_lengths, late.rays.path_lengths);
        }
    }
}

TEST(Determinism, OfSplitsInTwoPools) {
    RenderSettings settings = uneven();
    settings.samples = 3;
    settings.splits.reflections = 3;
    settings.split_depth = 2;
    const RenderResult first = render_scene(room(), settings);
    settings.pool = 500;
    settings.work_groups = {16, 64};
    expect_same_bits(first, render_scene(room(), settings));
}

// Fog and, on the floor, glass, both of which transmit in part.
TEST(Determinism, OfPartialBoundariesInTwoPools) {
    Scene scene = room();
    add_box(
        scene, in_part(boundary_of(medium_of(2, 0.9)), 0.7, 0.2), {-.9, -.9, -.9}, {.9, .85, .7},
        Facing::outward);
    add_box(scene, in_part(glass(1.5), 0.6), {0.2, -1, 0}, {0.7, -0.6, 0.5}, Facing::outward);
    for (const uint32_t splits : {1U, 2U}) {
        RenderSettings settings = uneven();
        settings.samples = 5;
        settings.method.distances = Distances::mis;
        settings.splits = {splits, splits, splits};
        const RenderResult first = render_scene(scene, settings);
        ASSERT_TRUE(std::ranges::any_of(
            first.profile, [](const ProfileRow& row) { return row.name == "find_contacts"; }));
        settings.pool = 500;
        settings.work_groups = {16, 64};
        expect_same_bits(first, render_scene(scene, settings));
    }
}

// 20480 triangles are traced by streams on a CPU; pools decide which rays share one.
TEST(Determinism, OfStreamsInTwoPools) {
    Scene scene = room();
    add_icosphere(scene, lambert(grey(0.6F)), {0.4, -0.4, 0.3}, 0.4, 5);
    RenderSettings settings = uneven();
    const RenderResult first = render_scene(scene, settings);
    ASSERT_GE(first.bvh_nodes, 1024U);
    settings.pool = 100;
    expect_same_bits(first, render_scene(scene, settings));
}

// Where something touches, rays start behind a triangle: streams too, without any medium.
TEST(Determinism, OfStreamsThatMeetAWindowOnAWall) {
    Scene scene = room();
    add_icosphere(scene, lambert(grey(0.6F)), {0.4, -0.4, 0.3}, 0.4, 5);
    Material window = lambert(grey(0.9F));
    window.transmission = 1;
    add_square(scene, window, {0, 0, -1 + 1e-7}, {0, 0, 1}, 1);
    RenderSettings settings = uneven();
    const RenderResult first = render_scene(scene, settings);
    ASSERT_GE(first.bvh_nodes, 1024U);
    ASSERT_TRUE(std::ranges::any_of(
        first.profile, [](const ProfileRow& row) { return row.name == "find_contacts"; }));
    settings.pool = 100;
    expect_same_bits(first, render_scene(scene, settings));
}

// A CPU traces rays of a small mesh in packets, unless some of it has holes: here the light's mask,
// which has none. Fog clear of the walls: rays pass two boundaries at once and look behind.
TEST(Determinism, OfPacketsAndSingleRays) {
    Scene fog = room();
    add_box(fog, boundary_of(medium_of(0.4, 0.9)), {-.9, -.9, -.9}, {.9, .85, .7}, Facing::outward);
    for (const uint32_t splits : {1U, 3U})
        for (Scene scene : {room(), fog}) {
            SCOPED_TRACE(fmt::format("{} materials, {} splits", scene.materials.size(), splits));
            RenderSettings settings = uneven();
            settings.pool = 1000;
            settings.splits.reflections = splits;
            const RenderResult packets = render_scene(scene, settings);
            ASSERT_LE(packets.triangles, SMALL_MESH_TRIANGLES);
            scene.materials[1].alpha_mode = AlphaMode::mask;
            scene.materials[1].alpha_cutoff = 0.5F;
            const RenderResult single = render_scene(scene, settings);
            expect_same_bits(packets, single);
            EXPECT_EQ(packets.rays.closest, single.rays.closest);
            EXPECT_EQ(packets.rays.connections, single.rays.connections);
        }
}

// Rays go on behind smooth walls alike, however they are traced.
TEST(Determinism, OfRaysThatPassWalls) {
    Scene scene = room();
    Material window = dielectric(grey(0.9F), 0);
    window.transmission = 0.8F;
    for (const double z : {0.1, 0.3}) add_square(scene, window, {0, 0, z}, {0.2, 0, 1}, 1.5);
    RenderSettings settings = uneven();
    settings.pool = 1000;
    for (const uint32_t splits : {1U, 3U}) {
        settings.splits.reflections = splits;
        const RenderResult packets = render_scene(scene, settings);
        ASSERT_LE(packets.triangles, SMALL_MESH_TRIANGLES);
        Scene single = scene;
        single.materials[1].alpha_mode = AlphaMode::mask;
        single.materials[1].alpha_cutoff = 0.5F;
        expect_same_bits(packets, render_scene(single, settings));
    }
    add_icosphere(scene, lambert(grey(0.6F)), {0.4, -0.4, -0.3}, 0.4, 5);
    const RenderResult stream = render_scene(scene, settings);
    ASSERT_GE(stream.bvh_nodes, 1024U);
    settings.pool = 100;
    settings.work_groups = {16, 64};
    expect_same_bits(stream, render_scene(scene, settings));
}

TEST(Determinism, OfTwoSeedsTheyDiffer) {
    RenderSettings settings = uneven();
    settings.seed = 2;
    EXPECT_NE(
        render_scene(room(), uneven()).film.image.channels.at("R"),
        render_scene(room(), settings).film.image.channels.at("R"));
}

// The number of threads is fixed when PoCL starts: a process each.
TEST(Determinism, OfOneCoreAndTwo) {
    if (test_device().info.platform != "Portable Computing Language")
        GTEST_SKIP() << "the number of cores can be chosen on PoCL only, not on "
                     << test_device().info.platform;
    const TemporaryFolder folder;
    const auto picture = [&](const char* threads, const std::string& arguments) {
        // the name up to PoCL 3, and since
        const EnvironmentVariable count("POCL_MAX_PTHREAD_COUNT", threads);
        const EnvironmentVariable newer_count("POCL_CPU_MAX_CU_COUNT", threads);
        const std::string name = std::string("threads_") + threads + ".exr";
        const std::string command =
            std::string("'" WAVEPATH_BINARY "' render '" WAVEPATH_SOURCE_DIR "'/scenes/") +
            arguments + " --size 48x40 --spp 20 --quiet -o '" + (folder / name).string() + "'";
        EXPECT_EQ(std::system(command.c_str()), 0) << command;
        return folder.read(name);
    };
    for (const char* arguments :
         {"cornell_box/scene.gltf", "fog_shaft/scene.gltf", "glass_of_liquid/scene.gltf",
          "fog_shaft/scene.gltf --distance mis --splits 2,2,2"}) {
        const std::string one = picture("1", arguments);
        EXPECT_GT(one.size(), std::size_t{48} * 40 * 4);
        EXPECT_TRUE(one == picture("2", arguments)) << arguments;
    }
}

}  // namespace
}  // namespace wavepath
