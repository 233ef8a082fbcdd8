#include "support/probe.h"
#include "support/rendering.h"

#include <gmock/gmock.h>

namespace wavepath {
namespace {

// All buffers together, each of which fits.
TEST(Renderer, RefusesMoreMemoryThanTheDeviceHas) {
    Scene scene = scene_named("square");
    add_square(scene, lambert(grey(0.5F), grey(1)), {0, 0, 0}, {0, 0, 1}, 1);
    const RenderSettings settings = square_settings("mis", close_up({}, {0, 0, 1}, 1, 0.5), 64, 1);
    Device device = test_device();
    const RenderResult result = render(device, scene, settings);
    const uint64_t needed = result.scene_bytes + result.pool_bytes + result.film_bytes;
    device.info.global_memory = needed;
    EXPECT_NO_THROW(render(device, scene, settings));
    device.info.global_memory = needed - 1;
    try {
        render(device, scene, settings);
        FAIL() << "rendered in " << needed - 1 << " bytes";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("MiB of device memory needed"));
    }
}

TEST(Renderer, WarnsOfVariancesTooLargeForFloats) {
    const Camera camera = close_up({}, {0, 0, 1}, 1, 0.5);
    const RenderSettings settings = square_settings("path", camera, 8, 64);
    for (const auto& [radiance, warned] : {std::pair{1e15F, false}, {1e20F, true}}) {
        Scene scene = scene_named("square");
        add_square(scene, lambert(grey(0.5F)), {0, 0, 0}, {0, 0, 1}, 1);
        add_square(scene, lambert(grey(0), grey(radiance)), {0, 0, 1}, {0, 0, -1}, 1);
        const auto of_variance = testing::Contains(testing::HasSubstr("variance layer"));
        const RenderResult result = render(test_device(), scene, settings);
        EXPECT_EQ(testing::Value(result.warnings, of_variance), warned) << radiance;
    }
}

}  // namespace
}  // namespace wavepath
