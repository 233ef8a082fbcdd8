// Texels, wrapping and filtering against a plain double-precision reading of glTF 2.0,
// section 3.9.2.
#include "shared/texture.h"
#include "support/probe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <random>

namespace wavepath {
namespace {

const std::string kernels = R"(
kernel void lookups(
    const uint count, global float* out, TEXTURE_PARAMETERS, global const float* places) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    const Texel t = texture_eval(TEXTURES, textures, places[2 * i], places[2 * i + 1]);
    out[4 * i] = t.r;
    out[4 * i + 1] = t.g;
    out[4 * i + 2] = t.b;
    out[4 * i + 3] = t.a;
}
)";

constexpr std::size_t page_words =
    300;  // the image begins in the first page and ends in the second

const Probe& one_page() {
    static const Probe& instance =
        *new Probe({"materials/texture.cl"}, kernels, "#define TEXTURE_PAGES 1\n");
    return instance;
}

const Probe& two_pages() {
    static const Probe& instance = *new Probe(
        {"materials/texture.cl"}, kernels,
        fmt::format("#define TEXTURE_PAGES 2\n#define TEXTURE_PAGE_WORDS {}u\n", page_words));
    return instance;
}

double linear_of_srgb(double c) {
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

// An image of random codes behind the curve of 8-bit codes.
struct TestTexture {
    DeviceTexture row{};
    std::vector<cl_uint> words;
    std::vector<uint32_t> codes;  // 4 a texel
    double most = 255;

    TestTexture(uint32_t width, uint32_t height, cl_uint flags) {
        row.width = width;
        row.height = height;
        row.flags = flags;
        const bool wide = (flags & TEXTURE_16_BITS) != 0;
        if (wide) most = 65535;
        for (int code = 0; code < 256; ++code)
            words.push_back(
                std::bit_cast<cl_uint>(static_cast<float>(linear_of_srgb(code / 255.0))));
        if (wide && (flags & TEXTURE_SRGB) != 0)
            for (int code = 0; code < 65536; ++code)
                words.push_back(
                    std::bit_cast<cl_uint>(static_cast<float>(linear_of_srgb(code / 65535.0))));
        row.first_word = static_cast<cl_uint>(words.size());
        std::mt19937 random(width * 7 + height);
        for (uint32_t i = 0; i < width * height; ++i) {
            std::array<uint32_t, 4> c;
            for (uint32_t& code : c) code = static_cast<uint32_t>(random() % (wide ? 65536 : 256));
            codes.insert(codes.end(), c.begin(), c.end());
            if (wide) {
                words.push_back(c[0] | c[1] << 16U);
                words.push_back(c[2] | c[3] << 16U);
            } else {
                words.push_back(c[0] | c[1] << 8U | c[2] << 16U | c[3] << 24U);
            }
        }
    }

    double texel(int64_t x, int64_t y, int channel) const {
        const auto side = [](int64_t i, int64_t size, bool clamps, bool mirrors) {
            if (clamps) return std::clamp<int64_t>(i, 0, size - 1);
            const int64_t period = mirrors ? 2 * size : size;
            const int64_t within = (i % period + period) % period;
            return within < size ? within : period - 1 - within;
        };
        const int64_t column = side(
            x, row.width, (row.flags & TEXTURE_CLAMP_S) != 0, (row.flags & TEXTURE_MIRROR_S) != 0);
        const int64_t line = side(
            y, row.height, (row.flags & TEXTURE_CLAMP_T) != 0, (row.flags & TEXTURE_MIRROR_T) != 0);
        const auto at = static_cast<std::size_t>(4 * (line * row.width + column) + channel);
        const double code = codes[at] / most;
        return (row.flags & TEXTURE_SRGB) != 0 && channel < 3 ? linear_of_srgb(code) : code;
    }

    double expected(double s, double t, int channel) const {
        const double x = s * row.width;
        const double y = t * row.height;
        if ((row.flags & TEXTURE_NEAREST) != 0) {
            return texel(
                static_cast<int64_t>(std::floor(x)), static_cast<int64_t>(std::floor(y)), channel);
        }
        const auto column = static_cast<int64_t>(std::floor(x - 0.5));
        const auto line = static_cast<int64_t>(std::floor(y - 0.5));
        const double fx = x - 0.5 - static_cast<double>(column);
        const double fy = y - 0.5 - static_cast<double>(line);
        return (1 - fy) * ((1 - fx) * texel(column, line, channel) +
                           fx * texel(column + 1, line, channel)) +
               fy * ((1 - fx) * texel(column, line + 1, channel) +
                     fx * texel(column + 1, line + 1, channel));
    }

    // Where the coordinate is exact in float, the lookup is a few roundings off at the most.
    void check(const std::vector<cl_float>& places) const {
        const std::vector<cl_uint> rest(1, 0);
        const std::vector<cl_uint> second(
            words.size() > page_words ? words.begin() + page_words : words.end() - 1, words.end());
        const std::vector<DeviceTexture> rows{row};
        const std::size_t count = places.size() / 2;
        const auto whole = one_page().run<cl_float>(
            "lookups", count, 4 * count, rows, words, rest, rest, rest, places);
        if (words.size() <= 2 * page_words) {
            const auto paged = two_pages().run<cl_float>(
                "lookups", count, 4 * count, rows, words, second, rest, rest, places);
            EXPECT_EQ(whole, paged);
        }
        for (std::size_t i = 0; i < 4 * count; ++i)
            ASSERT_NEAR(
                whole[i],
                expected(places[i / 4 * 2], places[i / 4 * 2 + 1], static_cast<int>(i % 4)), 1e-6)
                << "(" << places[i / 4 * 2] << ", " << places[i / 4 * 2 + 1] << "), channel "
                << i % 4;
    }
};

// Points on a lattice finer than the texels, over several repeats and on both sides of zero; exact
// in float for images of a power of two.
// `off`: from the borders of texels.
std::vector<cl_float> lattice(double step, double off = 0) {
    std::vector<cl_float> places;
    for (double s = -2.25; s <= 2.25; s += step)
        for (double t = -1.25; t <= 1.25; t += step)
            places.insert(
                places.end(), {static_cast<cl_float>(s + off), static_cast<cl_float>(t + off)});
    return places;
}

TEST(Texture, WrapsAndFiltersAtItsBorders) {
    for (const cl_uint s : {0U, TEXTURE_CLAMP_S, TEXTURE_MIRROR_S})
        for (const cl_uint t : {0U, TEXTURE_CLAMP_T, TEXTURE_MIRROR_T})
            for (const cl_uint filter : {0U, TEXTURE_NEAREST}) {
                SCOPED_TRACE(fmt::format("flags {}", s | t | filter));
                TestTexture(16, 8, s | t | filter)
                    .check(lattice(1.0 / 32, filter == TEXTURE_NEAREST ? 1.0 / 256 : 0));
            }
}

TEST(Texture, OfASingleTexelIsThatTexel) {
    TestTexture(1, 1, 0).check(lattice(1.0 / 8));
    TestTexture(1, 1, TEXTURE_MIRROR_S | TEXTURE_CLAMP_T).check(lattice(1.0 / 8));
}

TEST(Texture, DecodesTheSrgbCurveBeforeItFilters) {
    TestTexture(16, 8, TEXTURE_SRGB).check(lattice(1.0 / 64));
    TestTexture(16, 16, TEXTURE_SRGB | TEXTURE_NEAREST).check(lattice(1.0 / 32, 1.0 / 256));
}

TEST(Texture, KeepsSixteenBits) {
    TestTexture(16, 8, TEXTURE_16_BITS).check(lattice(1.0 / 64));
    TestTexture(16, 8, TEXTURE_16_BITS | TEXTURE_SRGB).check(lattice(1.0 / 64));
}

TEST(Texture, WithoutAnImageIsWhite) {
    TestTexture none(1, 1, 0);
    none.row.width = 0;
    const std::vector<cl_uint> rest(1, 0);
    EXPECT_EQ(
        one_page().run<cl_float>(
            "lookups", 1, 4, std::vector<DeviceTexture>{none.row}, rest, rest, rest, rest,
            std::vector<cl_float>{0.5F, 0.5F}),
        (std::vector<cl_float>{1, 1, 1, 1}));
}

}  // namespace
}  // namespace wavepath
