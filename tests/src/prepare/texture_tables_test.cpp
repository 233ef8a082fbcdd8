#include "prepare/texture_tables.h"

#include "error.h"
#include "support/textured_scenes.h"

#include <gmock/gmock.h>

#include <bit>
#include <cmath>

namespace wavepath {
namespace {

// A plate whose base colour is an image of the sRGB curve.
Scene srgb_plate(TextureImage image) {
    Scene scene = scene_named("plate");
    add_plate(scene, lambert(grey(1)));
    add_texture(scene, scene.materials[0], TEXTURE_BASE_COLOR, std::move(image)).srgb = true;
    return scene;
}

constexpr uint64_t large_page = 1U << 30U;

// IEC 61966-2-1, every code.
TEST(TextureTables, HoldTheSrgbCurve) {
    TextureTables tables =
        build_texture_tables(srgb_plate(texel_image(0.5, 0.5, 0.5)), {true}, large_page);
    ASSERT_EQ(tables.curves.size(), 256U + 65536U);
    const auto check = [&](std::size_t first, uint32_t codes) {
        for (uint32_t code = 0; code < codes; ++code) {
            const long double c = static_cast<long double>(code) / (codes - 1);
            const long double linear =
                c <= 0.04045L ? c / 12.92L : std::pow((c + 0.055L) / 1.055L, 2.4L);
            const auto found = std::bit_cast<float>(tables.curves[first + code]);
            ASSERT_NEAR(found, static_cast<double>(linear), 6e-8 * static_cast<double>(linear))
                << code << " of " << codes;
        }
    };
    check(SRGB_8_TABLE, 256);
    check(SRGB_16_TABLE, 65536);
    // no image of 16 bits: the small table alone; no image of the curve: none
    Scene scene = srgb_plate(image_of(1, 1, {1, 2, 3, 4}));
    EXPECT_EQ(build_texture_tables(scene, {true}, large_page).curves.size(), 256U);
    scene.materials[0].textures[TEXTURE_BASE_COLOR].srgb = false;
    EXPECT_TRUE(build_texture_tables(scene, {true}, large_page).curves.empty());
}

TEST(TextureTables, AreEmptyWhereNoTriangleWearsThem) {
    const TextureTables tables =
        build_texture_tables(srgb_plate(image_of(1, 1, {1, 2, 3, 4})), {false}, large_page);
    EXPECT_TRUE(tables.rows.empty());
    EXPECT_EQ(tables.pages(), 0U);
}

TEST(TextureTables, SayWhatDoesNotFit) {
    const Scene scene =
        srgb_plate(image_of(1024, 1024, std::vector<uint8_t>(std::size_t{4} << 20U, 9)));
    EXPECT_EQ(build_texture_tables(scene, {true}, 2U << 20U).pages(), 3U);
    try {
        build_texture_tables(scene, {true}, 1U << 20U);  // the curve makes it 5 pages
        FAIL() << "fits";
    } catch (const Error& error) {
        EXPECT_STREQ(
            error.what(),
            "plate: textures take 4 MiB, the device holds 4 MiB; shrink them, or use another "
            "--device");
    }
}

}  // namespace
}  // namespace wavepath
