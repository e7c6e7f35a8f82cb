#include "image/image.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.h"
#include "base/files.h"
#include "base/parallel.h"
#include "base/srgb.h"
#include "image/file_check.h"
#include "image/layers.h"

namespace voxray {
namespace fs = std::filesystem;

namespace {

constexpr uint64_t maxPixels = 1ull << 28;
constexpr int maxSide = 1 << 16;

// A library's message, which may be empty.
std::string reasonOr(const std::string& message) {
    return message.empty() ? "unknown reason" : message;
}

void checkSpec(const OIIO::ImageSpec& spec, const std::string& name) {
    if (spec.deep) throw Error("{}: is a deep image; store it flat", name);
    if (spec.width <= 0 || spec.height <= 0 || spec.depth > 1 || spec.nchannels <= 0)
        throw Error("{}: is not a picture ({} x {} x {}, {} channels)", name, spec.width, spec.height, spec.depth,
                    spec.nchannels);
    if (uint64_t(spec.width) * uint64_t(spec.height) > maxPixels || std::max(spec.width, spec.height) > maxSide)
        throw Error("{}: {} x {} pixels are too many: at most {}, and {} on a side", name, spec.width, spec.height,
                    maxPixels, maxSide);
}

// Reads in strips and allocates as they arrive, so that a small file with a huge size costs no memory.
template <typename T>
std::vector<T> readPixels(OIIO::ImageInput& input, const std::string& name, int firstChannel, int channels,
                          OIIO::TypeDesc type) {
    const OIIO::ImageSpec& spec = input.spec();
    const int strip = spec.tile_height > 0 ? spec.tile_height : 64;
    const size_t rowValues = size_t(spec.width) * size_t(channels);
    const int lastChannel = firstChannel + channels;
    const int part = input.current_subimage();
    std::vector<T> values;
    for (int row = 0; row < spec.height; row += strip) {
        const int begin = spec.y + row;
        const int end = spec.y + std::min(row + strip, spec.height);
        const size_t offset = values.size();
        values.resize(offset + rowValues * size_t(end - begin));
        const bool read =
            spec.tile_width > 0
                ? input.read_tiles(part, 0, spec.x, spec.x + spec.width, begin, end, spec.z, spec.z + 1, firstChannel,
                                   lastChannel, type, &values[offset])
                : input.read_scanlines(part, 0, begin, end, spec.z, firstChannel, lastChannel, type, &values[offset]);
        if (!read) throw Error("{}: is broken or truncated: {}", name, reasonOr(input.geterror()));
    }
    return values;
}

// Keeps the colour of transparent pixels.
OIIO::ImageSpec openOptions() {
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);
    return config;
}

void checkChannels(const fs::path& path, const ImageF& image) {
    if (image.channels != 1 && image.channels != 3)
        throw Error("{}: cannot write {} channels, only 1 or 3", path.string(), image.channels);
}

void checkWritable(const fs::path& path, const ImageF& image) {
    if (image.width == 0 || image.height == 0) throw Error("{}: the image is empty", path.string());
    if (image.data.size() != image.pixelCount() * image.channels)
        throw Error("{}: {} values do not fill {} x {} pixels of {} channels", path.string(), image.data.size(),
                    image.width, image.height, image.channels);
}

// Reports a full disk, which libraries don't.
std::string freeMiB(const fs::path& path) {
    std::error_code code;
    const fs::space_info space = fs::space(fs::absolute(path).parent_path(), code);
    return code ? "?" : std::to_string(space.available >> 20);
}

/// @param path for errors, of the file that becomes `temporary`.
void write(const fs::path& path, const fs::path& temporary, const char* format, const OIIO::ImageSpec& spec,
           OIIO::TypeDesc type, const void* values) {
    const std::unique_ptr<OIIO::ImageOutput> out = OIIO::ImageOutput::create(format);
    if (!out) throw Error("{}: no writer for {}: {}", path.string(), format, reasonOr(OIIO::geterror()));
    if (!out->open(temporary.string(), spec) || !out->write_image(type, values) || !out->close())
        throw Error("{}: {}; {} MiB are free there", path.string(), reasonOr(out->geterror()), freeMiB(path));
}

void writeWhole(const fs::path& path, const char* format, const OIIO::ImageSpec& spec, OIIO::TypeDesc type,
                const void* values) {
    writeFileAtomically(path, [&](const fs::path& temporary) { write(path, temporary, format, spec, type, values); });
}

std::vector<std::string> channelNamesOf(const ImageF& image) {
    if (image.channels == 3) return {"R", "G", "B"};
    return {"Y"};
}

/// @throws Error if an image of these channels can't be written.
OIIO::ImageSpec exrSpec(const fs::path& path, const ImageF& image, const std::vector<std::string>& channelNames,
                        const char* compression) {
    checkWritable(path, image);
    if (channelNames.size() != image.channels)
        throw Error("{}: {} names for {} channels", path.string(), channelNames.size(), image.channels);
    OIIO::ImageSpec spec(int(image.width), int(image.height), int(image.channels), OIIO::TypeDesc::FLOAT);
    spec.channelnames = channelNames;
    spec.attribute("compression", compression);
    // Fixed date, since OpenImageIO writes the time of day: equal images should be equal files.
    spec.attribute("DateTime", "1970:01:01 00:00:00");
    return spec;
}

/// Display values in 8 bits. @throws Error for NaN.
std::vector<uint8_t> displayBytes(const std::string& name, const ImageF& display) {
    std::vector<uint8_t> bytes(display.data.size());
    for (size_t i = 0; i < bytes.size(); ++i) {
        const float value = display.data[i];
        if (std::isnan(value)) {
            const size_t pixel = i / display.channels;
            throw Error("{}: the image has NaN at ({}, {})", name, pixel % display.width, pixel / display.width);
        }
        bytes[i] = uint8_t(std::clamp(value, 0.0f, 1.0f) * 255.0f + 0.5f);
    }
    return bytes;
}

}  // namespace

LayeredImage readLayer(const fs::path& path, const std::string& wanted) {
    const std::string name = path.string();
    const std::vector<uint8_t> file = readFile(path);
    checkIntegrity(file, name);
    try {
        // Open, and check the dimensions before allocation.
        const OIIO::ImageSpec config = openOptions();
        const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(name, &config);
        if (!input)
            throw Error("{}: is no image that Voxray reads (EXR, HDR, PNG or JPEG); OpenImageIO says: {}", name,
                        reasonOr(OIIO::geterror()));
        const bool exr = std::string_view(input->format_name()) == "openexr";
        if (!exr && !wanted.empty()) throw Error("{}: it has no layers; only EXR files have", name);
        const std::vector<Layer> layers = exr ? layersOf(*input) : std::vector<Layer>();
        Layer layer;
        if (exr) layer = chooseLayer(layers, wanted, name);
        if (!input->seek_subimage(layer.part, 0)) throw Error("{}: is broken: {}", name, reasonOr(input->geterror()));
        const OIIO::ImageSpec spec = input->spec();
        checkSpec(spec, name);
        if (!exr) layer.channels = spec.nchannels >= 3 ? std::vector{0, 1, 2} : std::vector{0};
        for (const int channel : layer.channels)
            if (exr && !spec.channelformat(channel).is_floating_point())
                throw Error("{}: its layer '{}' holds whole numbers, not radiance", name, layer.name);

        // Files of integers have display values.
        const auto [first, last] = std::minmax_element(layer.channels.begin(), layer.channels.end());
        const int count = *last - *first + 1;
        std::vector<float> values = readPixels<float>(*input, name, *first, count, OIIO::TypeDesc::FLOAT);
        if (!exr && !spec.format.is_floating_point())
            parallelRanges(values.size(), 1 << 14, [&](size_t begin, size_t end) {
                for (size_t i = begin; i < end; ++i) values[i] = srgbDecode(values[i]);
            });

        // Grey becomes three equal channels.
        LayeredImage read{ImageF(uint32_t(spec.width), uint32_t(spec.height), 3), layer.name, layers.size()};
        for (size_t i = 0; i < read.image.data.size(); ++i) {
            const int channel = layer.channels[layer.channels.size() == 3 ? i % 3 : 0];
            read.image.data[i] = values[i / 3 * size_t(count) + size_t(channel - *first)];
        }
        return read;
    } catch (const Error&) {
        throw;
    } catch (const std::exception& error) {
        throw Error("{}: is broken: {}", name, reasonOr(error.what()));
    }
}

ImageF readImage(const fs::path& path) {
    return readLayer(path, "").image;
}

DecodedImage decodeImage(std::span<const uint8_t> encoded, const char* name) {
    const char* format = isPng(encoded) ? "png" : isJpeg(encoded) ? "jpeg" : isWebp(encoded) ? "webp" : nullptr;
    if (format == nullptr) throw Error("{}: is neither PNG, JPEG nor WebP{}", name, adviceFor(encoded));
    std::vector<uint8_t> completed;
    if (isJpeg(encoded) && !hasJpegEnd(encoded)) {
        // A missing end marker is tolerated; the decoder reports missing data.
        completed.assign(encoded.begin(), encoded.end());
        completed.insert(completed.end(), {0xff, 0xd9});
        encoded = completed;
    }
    checkIntegrity(encoded, name);
    try {
        // Open from memory.
        OIIO::Filesystem::IOMemReader reader(const_cast<uint8_t*>(encoded.data()), encoded.size());
        OIIO::Filesystem::IOProxy* proxy = &reader;
        OIIO::ImageSpec config = openOptions();
        config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
        const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create(format);
        if (!input) throw Error("{}: no reader: {}", name, reasonOr(OIIO::geterror()));
        OIIO::ImageSpec opened;
        if (!input->open(name, opened, config)) throw Error("{}: is broken: {}", name, reasonOr(input->geterror()));
        const OIIO::ImageSpec spec = input->spec();
        checkSpec(spec, name);
        const int channels = std::min(spec.nchannels, 4);
        const std::vector<uint8_t> values = readPixels<uint8_t>(*input, name, 0, channels, OIIO::TypeDesc::UINT8);
        if (!completed.empty() && input->has_error())
            throw Error("{}: is broken or truncated: {}", name, reasonOr(input->geterror()));

        // Spread grey (1), grey and alpha (2), RGB (3) and RGBA (4) to RGBA.
        DecodedImage image{uint32_t(spec.width), uint32_t(spec.height), {}};
        const size_t pixels = size_t(image.width) * image.height;
        image.rgba.resize(pixels * 4);
        const bool grey = channels <= 2;
        const bool alpha = channels == 2 || channels == 4;
        for (size_t i = 0; i < pixels; ++i) {
            const uint8_t* from = &values[i * size_t(channels)];
            uint8_t* to = &image.rgba[i * 4];
            for (int c = 0; c < 3; ++c) to[c] = from[grey ? 0 : c];
            to[3] = alpha ? from[channels - 1] : uint8_t(255);
        }
        return image;
    } catch (const Error&) {
        throw;
    } catch (const std::exception& error) {
        throw Error("{}: is broken: {}", name, reasonOr(error.what()));
    }
}

void writeExr(const fs::path& path, const ImageF& image) {
    checkChannels(path, image);
    writeExr(path, image, channelNamesOf(image));
}

void writeExr(const fs::path& path, const ImageF& image, const std::vector<std::string>& channelNames) {
    const OIIO::ImageSpec spec = exrSpec(path, image, channelNames, "zip");
    writeWhole(path, "openexr", spec, OIIO::TypeDesc::FLOAT, image.data.data());
}

void writePlainExr(const fs::path& path, const ImageF& image) {
    checkChannels(path, image);
    const OIIO::ImageSpec spec = exrSpec(path, image, channelNamesOf(image), "none");
    write(path, path, "openexr", spec, OIIO::TypeDesc::FLOAT, image.data.data());
}

void writePng(const fs::path& path, const ImageF& display) {
    checkChannels(path, display);
    checkWritable(path, display);
    const std::vector<uint8_t> bytes = displayBytes(path.string(), display);
    OIIO::ImageSpec spec(int(display.width), int(display.height), int(display.channels), OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    writeWhole(path, "png", spec, OIIO::TypeDesc::UINT8, bytes.data());
}

std::vector<uint8_t> encodePng(const ImageF& display) {
    const std::vector<uint8_t> bytes = displayBytes("image", display);
    DecodedImage rgba{display.width, display.height, std::vector<uint8_t>(display.pixelCount() * 4, 255)};
    for (size_t i = 0; i < display.pixelCount(); ++i)
        for (size_t c = 0; c < 3; ++c)
            rgba.rgba[i * 4 + c] = bytes[i * display.channels + std::min(c, size_t(display.channels) - 1)];
    return encodePng(rgba);
}

std::vector<uint8_t> encodePng(const DecodedImage& image) {
    if (image.width == 0 || image.height == 0 || image.rgba.size() != size_t(image.width) * image.height * 4)
        throw Error("a picture of {} x {} with {} bytes can't be a PNG", image.width, image.height, image.rgba.size());
    std::vector<unsigned char> file;
    OIIO::Filesystem::IOVecOutput writer(file);
    OIIO::Filesystem::IOProxy* proxy = &writer;
    OIIO::ImageSpec spec(int(image.width), int(image.height), 4, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:UnassociatedAlpha", 1);
    spec.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
    const std::unique_ptr<OIIO::ImageOutput> out = OIIO::ImageOutput::create("png");
    if (!out) throw Error("no writer for png: {}", reasonOr(OIIO::geterror()));
    if (!out->open("memory.png", spec) || !out->write_image(OIIO::TypeDesc::UINT8, image.rgba.data()) || !out->close())
        throw Error("a PNG can't be made: {}", reasonOr(out->geterror()));
    return file;
}

ImageF preview(const ImageF& linear, float exposureStops, ToneCurve tone) {
    ImageF display = linear;
    const double scale = std::exp2(double(exposureStops));
    parallelRanges(display.pixelCount(), 1 << 13, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            float* pixel = &display.data[i * display.channels];
            std::array<double, 3> color;
            for (uint32_t c = 0; c < 3; ++c) color[c] = pixel[std::min(c, display.channels - 1)] * scale;
            if (tone == ToneCurve::PbrNeutral) color = pbrNeutral(color);
            for (uint32_t c = 0; c < display.channels; ++c)
                pixel[c] = float(srgbEncode(std::clamp(color[c], 0.0, 1.0)));
        }
    });
    return display;
}

}  // namespace voxray
