#include "image/exr_writer.h"

#include "error.h"
#include "image/atomic_file.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStdIO.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <cassert>
#include <cerrno>
#include <cstring>
#include <fstream>

namespace wavepath {
namespace {

// Imf::OutputFile writes its line table in its destructor, which swallows a failure: AtomicFile
// keeps it.
class AtomicStream : public Imf::OStream {
  public:
    AtomicStream(AtomicFile& file, const std::string& name)
        : Imf::OStream(name.c_str()), file_(file) {}

    void write(const char* bytes, int count) override {
        file_.write({bytes, static_cast<std::size_t>(count)});
    }
    uint64_t tellp() override { return file_.position(); }
    void seekp(uint64_t position) override { file_.seek(position); }

  private:
    AtomicFile& file_;
};

void encode(const Image& image, Imf::OStream& stream) {
    Imf::Header header(static_cast<int>(image.width), static_cast<int>(image.height));
    header.compression() = Imf::ZIP_COMPRESSION;
    for (const auto& [name, value] : image.metadata)
        header.insert(name, Imf::StringAttribute(value));

    Imf::FrameBuffer planes;
    for (const auto& [name, plane] : image.channels) {
        assert(plane.size() == std::size_t{image.width} * image.height);
        header.channels().insert(name, Imf::Channel(Imf::FLOAT));
        // OpenEXR has one type of slice for reading and writing a file, without const.
        auto* data = const_cast<float*>(plane.data());
        planes.insert(name, Imf::Slice::Make(Imf::FLOAT, data, header.dataWindow()));
    }

    Imf::OutputFile file(stream, header);
    file.setFrameBuffer(planes);
    file.writePixels(static_cast<int>(image.height));
}

Image decode(Imf::InputFile& file, const std::string& path) {
    const Imf::Header& header = file.header();
    const Imath::Box2i window = header.dataWindow();
    if (window != header.displayWindow()) {
        throw Error(
            "{}: its data window is not its display window; apply oiiotool --croptofull to it",
            path);
    }

    Image image;
    image.width = static_cast<uint32_t>(window.max.x - window.min.x + 1);
    image.height = static_cast<uint32_t>(window.max.y - window.min.y + 1);
    Imf::FrameBuffer planes;
    for (auto entry = header.channels().begin(); entry != header.channels().end(); ++entry) {
        if (entry.channel().xSampling != 1 || entry.channel().ySampling != 1) {
            throw Error(
                "{}: channel {} is subsampled; convert the file to RGB", path, entry.name());
        }
        std::vector<float>& plane = image.channels[entry.name()];
        plane.resize(std::size_t{image.width} * image.height);
        planes.insert(entry.name(), Imf::Slice::Make(Imf::FLOAT, plane.data(), window));
    }
    file.setFrameBuffer(planes);
    file.readPixels(window.min.y, window.max.y);

    for (auto entry = header.begin(); entry != header.end(); ++entry) {
        const auto* text = dynamic_cast<const Imf::StringAttribute*>(&entry.attribute());
        if (text) image.metadata[entry.name()] = text->value();
    }
    return image;
}

}  // namespace

void check_writable(const std::filesystem::path& path) {
    const AtomicFile unused(path);
}

void write_exr(const Image& image, const std::filesystem::path& path) {
    AtomicFile file(path);
    AtomicStream stream(file, path.string());
    try {
        encode(image, stream);
    } catch (const Error&) {
        throw;
    } catch (const std::exception& reason) {
        throw Error(
            "{}: cannot be written as OpenEXR: {}; please report it", path.string(), reason.what());
    }
    file.commit({});
}

Image read_exr(const std::filesystem::path& path) {
    const std::string name = path.string();
    std::ifstream stream(path, std::ios::binary);
    if (!stream) throw Error("{}: cannot be read: {}; check the name", name, std::strerror(errno));
    try {
        Imf::StdIFStream input(stream, name.c_str());
        Imf::InputFile file(input);
        return decode(file, name);
    } catch (const Error&) {
        throw;
    } catch (const std::exception& reason) {
        throw Error(
            "{}: is not a whole OpenEXR image: {}; write or copy it again", name, reason.what());
    }
}

}  // namespace wavepath
