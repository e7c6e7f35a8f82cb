#include "scene/import/image_file.h"

#include <cstring>
#include <string>

#include "base/files.h"
#include "base/lower_case.h"
#include "base/srgb.h"
#include "scene/import/numbers.h"

namespace voxray {
namespace {

/// A word of a header, up to and with one space after it.
std::string takeWord(std::string_view& text) {
    text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
    const size_t length = std::min(text.find_first_of(" \t\r\n"), text.size());
    std::string word(text.substr(0, length));
    text.remove_prefix(std::min(length + 1, text.size()));
    return word;
}

/// Portable float map: "PF" or "Pf", size, scale whose sign is the byte order, rows from the bottom.
ImageF readPfm(const std::filesystem::path& path) {
    const std::vector<uint8_t> bytes = readFile(path);
    std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const std::string kind = takeWord(text);
    double numbers[3];
    for (double& number : numbers) {
        const std::string word = takeWord(text);
        std::string_view digits = word;
        const auto read = takeNumber(digits);
        if ((kind != "PF" && kind != "Pf") || !read) throw Error("{}: is no PFM file", path.string());
        number = *read;
    }
    const uint32_t channels = kind == "PF" ? 3 : 1;
    if (!(numbers[0] >= 1 && numbers[1] >= 1 && numbers[0] <= 65536 && numbers[1] <= 65536) ||
        text.size() / (4 * channels) < size_t(numbers[0]) * size_t(numbers[1]))
        throw Error("{}: is broken or truncated", path.string());
    ImageF image(static_cast<uint32_t>(numbers[0]), static_cast<uint32_t>(numbers[1]), 3);
    for (uint32_t y = 0; y < image.height; ++y)
        for (uint32_t x = 0; x < image.width; ++x)
            for (uint32_t c = 0; c < 3; ++c) {
                const size_t row = image.height - 1 - y;
                const size_t number = (row * image.width + x) * channels + (channels == 3 ? c : 0);
                uint32_t bits;
                std::memcpy(&bits, text.data() + 4 * number, 4);
                if (numbers[2] > 0) bits = __builtin_bswap32(bits);
                std::memcpy(image.pixel(x, y) + c, &bits, 4);
            }
    return image;
}

}  // namespace

ImageF readImageFile(const std::filesystem::path& path, bool srgb) {
    const std::string ending = lowerCase(path.extension().string());
    if (ending == ".pfm") return readPfm(path);
    ImageF image = readImage(path);
    const bool isFloat = ending == ".exr" || ending == ".hdr" || ending == ".rgbe";
    // readImage() decodes integers; the stored value is its inverse
    if (!srgb && !isFloat)
        for (float& value : image.data) value = srgbEncode(value);
    return image;
}

}  // namespace voxray
