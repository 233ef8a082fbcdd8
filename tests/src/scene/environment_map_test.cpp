#include "scene/environment_map.h"

#include "image/exr_writer.h"
#include "support/temporary_folder.h"

#include <gmock/gmock.h>

#include <limits>

namespace wavepath {
namespace {

using testing::HasSubstr;

std::string radiance_file(const std::string& resolution, const std::string& data) {
    return "#?RADIANCE\n# a comment\nGAMMA=1\nFORMAT=32-bit_rle_rgbe\n\n" + resolution + "\n" +
           data;
}

std::string bytes(std::initializer_list<int> values) {
    std::string result;
    for (const int value : values) result.push_back(static_cast<char>(value));
    return result;
}

// 2 x 2 texels, not compressed: a channel is mantissa x 2^(exponent - 136), 0 where the exponent is
// 0.
std::string flat_file() {
    return radiance_file(
        "-Y 2 +X 2", bytes({128, 64, 32, 129, 255, 0, 1, 128, 9, 9, 9, 0, 200, 100, 50, 144}));
}

// 8 x 1 texels, run-length encoded by channel: runs, literals, both.
std::string run_length_file() {
    return radiance_file(
        "-Y 1 +X 8", bytes({2, 2, 0, 8}) + bytes({136, 128}) + bytes({8, 0, 1, 2, 3, 4, 5, 6, 7}) +
                         bytes({132, 16, 4, 32, 64, 128, 255}) + bytes({136, 136}));
}

std::string message(const std::filesystem::path& path) {
    std::string text = error_of([&] { load_environment_map(path); });
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    return text;
}

TEST(EnvironmentMap, ReadsFlatRadiance) {
    const TemporaryFolder folder;
    const Environment map = load_environment_map(folder.write("flat.hdr", flat_file()));
    EXPECT_EQ(map.radiance, (Rgb{1, 1, 1}));
    EXPECT_EQ(map.width, 2u);
    EXPECT_EQ(map.height, 2u);
    EXPECT_EQ(
        map.pixels,
        (std::vector<float>{
            1.0f, 0.5f, 0.25f, 255.0f / 256, 0, 1.0f / 256, 0, 0, 0, 51200, 25600, 12800}));
}

TEST(EnvironmentMap, ReadsRunLengthEncodedRadiance) {
    const TemporaryFolder folder;
    const Environment map = load_environment_map(folder.write("runs.HDR", run_length_file()));
    const std::vector<float> blue{16, 16, 16, 16, 32, 64, 128, 255};
    ASSERT_EQ(map.pixels.size(), 24u);
    for (std::size_t x = 0; x < 8; ++x) {
        EXPECT_EQ(map.pixels[3 * x], 128.0f);
        EXPECT_EQ(map.pixels[3 * x + 1], static_cast<float>(x));
        EXPECT_EQ(map.pixels[3 * x + 2], blue[x]);
    }
}

TEST(EnvironmentMap, ReadsExr) {
    const TemporaryFolder folder;
    const Image colour{
        .width = 2,
        .height = 1,
        .channels =
            {{"R", {1, 2}},
             {"G", {3, 4}},
             {"B", {5, 1e6f}},
             {"A", {-1, -1}},
             {"depth.Z", {-1, -1}}},
        .metadata = {}};
    write_exr(colour, folder / "colour.exr");
    EXPECT_EQ(
        load_environment_map(folder / "colour.exr").pixels,
        (std::vector<float>{1, 3, 5, 2, 4, 1e6f}));

    write_exr(
        {.width = 1, .height = 2, .channels = {{"Y", {7, 8}}}, .metadata = {}},
        folder / "grey.exr");
    const Environment grey = load_environment_map(folder / "grey.exr");
    EXPECT_EQ(grey.width, 1u);
    EXPECT_EQ(grey.height, 2u);
    EXPECT_EQ(grey.pixels, (std::vector<float>{7, 7, 7, 8, 8, 8}));

    write_exr(
        {.width = 1, .height = 1, .channels = {{"R", {7}}, {"Y", {8}}}, .metadata = {}},
        folder / "red.exr");
    EXPECT_THAT(
        message(folder / "red.exr"), HasSubstr("red.exr: has neither channels R, G, B nor Y; "));
}

TEST(EnvironmentMap, RefusesEveryTruncation) {
    const TemporaryFolder folder;
    const std::string longer_than_a_buffer = radiance_file("-Y 30 +X 1", std::string(120, '\1'));
    for (const std::string& whole : {flat_file(), run_length_file(), longer_than_a_buffer}) {
        EXPECT_EQ(message(folder.write("whole.hdr", whole)), "");
        for (std::size_t size = 0; size < whole.size(); ++size) {
            const auto path = folder.write("part.hdr", std::string_view(whole).substr(0, size));
            EXPECT_THAT(message(path), HasSubstr("part.hdr: is "))
                << size << " of " << whole.size() << " bytes";
        }
    }
}

TEST(EnvironmentMap, RefusesTexelsThatAreNoRadiance) {
    const TemporaryFolder folder;
    const float infinity = std::numeric_limits<float>::infinity();
    for (const float bad : {-1e-6f, infinity, -infinity, std::numeric_limits<float>::quiet_NaN()}) {
        const Image image{
            .width = 2,
            .height = 2,
            .channels = {{"R", {0, 0, 0, 0}}, {"G", {0, 0, bad, 0}}, {"B", {0, 0, 0, 0}}},
            .metadata = {}};
        write_exr(image, folder / "bad.exr");
        EXPECT_THAT(message(folder / "bad.exr"), HasSubstr("bad.exr: texel (0, 1) holds ")) << bad;
    }
}

TEST(EnvironmentMap, RefusesWhatIsNoMap) {
    const TemporaryFolder folder;
    EXPECT_EQ(
        message(folder / "none.hdr"),
        (folder / "none.hdr").string() +
            ": cannot be read: No such file or directory; check the name");
    EXPECT_THAT(
        message(folder.path()), HasSubstr(": cannot be read: Is a directory; check the name"));
    EXPECT_THAT(
        message(folder.write("empty.hdr", "")), HasSubstr("empty.hdr: is empty or cut off; "));
    const auto refused = [&](const std::string& content) {
        return message(folder.write("a.hdr", content));
    };
    EXPECT_THAT(
        refused("not an image, but more than a signature"),
        HasSubstr("a.hdr: is no Radiance .hdr or OpenEXR"));
    EXPECT_THAT(
        refused("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n1234"),
        HasSubstr("unsupported format"));
    EXPECT_THAT(refused(radiance_file("+Y 1 +X 1", "1234")), HasSubstr("unsupported data layout"));
    EXPECT_THAT(refused(radiance_file("-Y 0 +X 0", "")), HasSubstr("a.hdr: holds no pixels; "));
    EXPECT_THAT(refused(radiance_file("-Y 1 +X -1", "1234")), HasSubstr("a.hdr: is no"));
    EXPECT_THAT(
        refused(radiance_file("-Y 1 +X 8", bytes({2, 2, 0, 8, 255, 1}))), HasSubstr("(corrupt)"));
}

}  // namespace
}  // namespace wavepath
