#include "image/exr_writer.h"

#include "support/temporary_folder.h"

#include <Imath/half.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfTestFile.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <gmock/gmock.h>

#include <bit>
#include <limits>

namespace wavepath {
namespace {

using testing::HasSubstr;

// 5 x 4 texels of every layer that a render has, with the floats that conversions lose first.
Image layered_image() {
    using Limits = std::numeric_limits<float>;
    Image image{
        .width = 5,
        .height = 4,
        .channels = {},
        .metadata = {{"wavepath.scene", "box.gltf"}, {"empty", ""}}};
    const std::vector<float> special{
        -0.0f,
        Limits::denorm_min(),
        Limits::max(),
        Limits::lowest(),
        Limits::infinity(),
        -Limits::infinity(),
        Limits::quiet_NaN(),
        std::bit_cast<float>(0xffc12345u),
        0x1.fffffep-1f,
        1e-20f};
    float next = 0.1f;
    for (const char* name : {"R", "G", "B", "albedo.R", "normal.X", "depth.Z", "variance.R"}) {
        std::vector<float>& plane = image.channels[name];
        plane = special;
        while (plane.size() < 20) plane.push_back(next *= 1.7f);
    }
    return image;
}

std::vector<uint32_t> bits(const std::vector<float>& plane) {
    std::vector<uint32_t> result;
    result.reserve(plane.size());
    for (const float value : plane) result.push_back(std::bit_cast<uint32_t>(value));
    return result;
}

TEST(ExrWriter, RoundTripIsBitEqual) {
    const TemporaryFolder folder;
    const Image written = layered_image();
    write_exr(written, folder / "a.exr");
    const Image read = read_exr(folder / "a.exr");
    EXPECT_EQ(read.width, 5u);
    EXPECT_EQ(read.height, 4u);
    EXPECT_EQ(read.metadata, written.metadata);
    ASSERT_EQ(read.channels.size(), written.channels.size());
    for (const auto& [name, plane] : written.channels) {
        ASSERT_TRUE(read.channels.contains(name)) << name;
        EXPECT_EQ(bits(read.channels.at(name)), bits(plane)) << name;
    }
}

TEST(ExrWriter, WritesOneScanlinePartOfZippedFloats) {
    const TemporaryFolder folder;
    write_exr(layered_image(), folder / "a.exr");
    bool tiled = true;
    bool deep = true;
    bool multi_part = true;
    ASSERT_TRUE(Imf::isOpenExrFile((folder / "a.exr").c_str(), tiled, deep, multi_part));
    EXPECT_FALSE(tiled || deep || multi_part);
    const Imf::InputFile file((folder / "a.exr").c_str());
    EXPECT_EQ(file.header().compression(), Imf::ZIP_COMPRESSION);
    EXPECT_EQ(file.header().dataWindow(), file.header().displayWindow());
    for (auto c = file.header().channels().begin(); c != file.header().channels().end(); ++c) {
        EXPECT_EQ(c.channel().type, Imf::FLOAT) << c.name();
    }
}

TEST(ExrWriter, SameImageGivesTheSameBytes) {
    const TemporaryFolder folder;
    write_exr(layered_image(), folder / "a.exr");
    write_exr(layered_image(), folder / "b.exr");
    EXPECT_EQ(folder.read("a.exr"), folder.read("b.exr"));
}

TEST(ExrWriter, KeepsTheOldFileWhereItFails) {
    const TemporaryFolder folder;
    folder.write("a.exr", "old");
    Image image = layered_image();
    image.metadata["channels"] = "a name that OpenEXR uses itself";
    EXPECT_THAT(
        error_of([&] { write_exr(image, folder / "a.exr"); }),
        HasSubstr("a.exr: cannot be written as OpenEXR"));
    EXPECT_EQ(folder.read("a.exr"), "old");
    EXPECT_EQ(folder.file_count(), 1u);
}

TEST(ExrWriter, CheckWritableTouchesNothing) {
    const TemporaryFolder folder;
    folder.write("old.exr", "old");
    EXPECT_NO_THROW(check_writable(folder / "old.exr"));
    EXPECT_NO_THROW(check_writable(folder / "new.exr"));
    EXPECT_EQ(folder.read("old.exr"), "old");
    EXPECT_EQ(folder.file_count(), 1u);
    EXPECT_THAT(
        error_of([&] { check_writable(folder / "none/new.exr"); }),
        HasSubstr("none/new.exr: cannot be written: folder "));
}

// 5 x 3 texels in tiles of 2 x 2 away from the origin: half i / 4 and unsigned 10^6 i.
void write_tiled(const std::filesystem::path& path) {
    const Imath::Box2i window({-3, 7}, {1, 9});
    std::vector<half> halves(15);
    std::vector<uint32_t> counts(15);
    for (uint32_t i = 0; i < 15; ++i) {
        halves[i] = 0.25f * static_cast<float>(i);
        counts[i] = 1000000 * i;
    }
    Imf::Header header(window, window);
    header.setTileDescription({2, 2});
    header.setType(Imf::TILEDIMAGE);
    header.channels().insert("Y", Imf::Channel(Imf::HALF));
    header.channels().insert("id", Imf::Channel(Imf::UINT));
    Imf::FrameBuffer planes;
    planes.insert("Y", Imf::Slice::Make(Imf::HALF, halves.data(), window));
    planes.insert("id", Imf::Slice::Make(Imf::UINT, counts.data(), window));
    Imf::TiledOutputFile file(path.c_str(), header);
    file.setFrameBuffer(planes);
    file.writeTiles(0, file.numXTiles() - 1, 0, file.numYTiles() - 1);
}

TEST(ExrReader, ConvertsHalfAndUnsignedAndTilesAtAnyOrigin) {
    const TemporaryFolder folder;
    write_tiled(folder / "tiled.exr");
    const Image image = read_exr(folder / "tiled.exr");
    ASSERT_EQ(image.width, 5u);
    ASSERT_EQ(image.height, 3u);
    for (uint32_t i = 0; i < 15; ++i) {
        EXPECT_EQ(image.channels.at("Y")[i], 0.25f * static_cast<float>(i));
        EXPECT_EQ(image.channels.at("id")[i], 1e6f * static_cast<float>(i));
    }
}

TEST(ExrReader, RefusesEveryTruncation) {
    const TemporaryFolder folder;
    write_exr(layered_image(), folder / "scanline.exr");
    write_tiled(folder / "tiled.exr");
    for (const char* name : {"scanline.exr", "tiled.exr"}) {
        const std::string whole = folder.read(name);
        for (std::size_t size = 0; size < whole.size(); ++size) {
            const auto path = folder.write("part.exr", std::string_view(whole).substr(0, size));
            const std::string message = error_of([&] { read_exr(path); });
            EXPECT_THAT(message, HasSubstr("part.exr: ")) << size << " bytes of " << name;
            EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        }
    }
}

TEST(ExrReader, RefusesWhatItWouldMisread) {
    const TemporaryFolder folder;
    const auto write_zeros = [&](const char* name, const Imf::Header& header, int sampling) {
        std::vector<float> zeros(64);
        Imf::FrameBuffer planes;
        planes.insert(
            "RY",
            Imf::Slice(
                Imf::FLOAT, reinterpret_cast<char*>(zeros.data()), 4, 32, sampling, sampling));
        Imf::OutputFile file((folder / name).c_str(), header);
        file.setFrameBuffer(planes);
        file.writePixels(header.dataWindow().max.y + 1);
    };
    Imf::Header subsampled(4, 4);
    subsampled.channels().insert("RY", Imf::Channel(Imf::FLOAT, 2, 2));
    write_zeros("subsampled.exr", subsampled, 2);
    EXPECT_THAT(
        error_of([&] { read_exr(folder / "subsampled.exr"); }),
        HasSubstr("channel RY is subsampled"));

    Imf::Header cropped(4, 4, Imath::Box2i({0, 0}, {1, 1}));
    cropped.channels().insert("RY", Imf::Channel(Imf::FLOAT));
    write_zeros("cropped.exr", cropped, 1);
    EXPECT_THAT(
        error_of([&] { read_exr(folder / "cropped.exr"); }), HasSubstr("oiiotool --croptofull"));

    EXPECT_THAT(
        error_of([&] { read_exr(folder / "none.exr"); }),
        HasSubstr("none.exr: cannot be read: No such file or directory; check the name"));
    EXPECT_THAT(
        error_of([&] { read_exr(folder.write("text.exr", "text")); }),
        HasSubstr("text.exr: is not a whole OpenEXR"));
    EXPECT_NE(error_of([&] { read_exr(folder.path()); }), "");
}

}  // namespace
}  // namespace wavepath
