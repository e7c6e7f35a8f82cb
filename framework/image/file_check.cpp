#include "image/file_check.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <tuple>

#include "base/error.h"

namespace voxray {
namespace {

constexpr std::array<uint32_t, 256> makeCrcTable() {
    std::array<uint32_t, 256> table{};
    for (uint32_t i = 0; i < 256; ++i) {
        uint32_t c = i;
        for (int bit = 0; bit < 8; ++bit) c = (c & 1) != 0 ? 0xedb88320u ^ (c >> 1) : c >> 1;
        table[i] = c;
    }
    return table;
}
constexpr std::array<uint32_t, 256> crcTable = makeCrcTable();

uint32_t crc(std::span<const uint8_t> bytes) {
    uint32_t c = 0xffffffffu;
    for (const uint8_t byte : bytes) c = crcTable[(c ^ byte) & 0xff] ^ (c >> 8);
    return ~c;
}

uint32_t bigEndian(const uint8_t* bytes) {
    return uint32_t(bytes[0]) << 24 | uint32_t(bytes[1]) << 16 | uint32_t(bytes[2]) << 8 | bytes[3];
}

// Checks a PNG's chunks (length, type, data, checksum of type and data) up to IEND. Checksums of optional
// chunks, with lower-case names, are ignored.
void checkPng(std::span<const uint8_t> bytes, const std::string& name) {
    for (size_t offset = 8; bytes.size() - offset >= 12;) {
        const size_t length = bigEndian(&bytes[offset]);
        if (bytes.size() - offset - 12 < length) break;
        const auto typeAndData = bytes.subspan(offset + 4, 4 + length);
        const std::string_view type(reinterpret_cast<const char*>(typeAndData.data()), 4);
        const bool isNamed = std::all_of(type.begin(), type.end(),
                                         [](char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); });
        if (!isNamed) throw Error("{}: is broken: a chunk has no name", name);
        const bool isCritical = (typeAndData[0] & 0x20) == 0;
        if (isCritical && crc(typeAndData) != bigEndian(&bytes[offset + 8 + length]))
            throw Error("{}: is broken: the checksum of a chunk is wrong", name);
        if (type == "IEND") return;
        offset += 12 + length;
    }
    throw Error("{}: is broken or truncated: its end is missing", name);
}

bool startsWith(std::span<const uint8_t> bytes, std::string_view magic, size_t offset = 0) {
    return bytes.size() >= offset + magic.size() &&
           std::equal(magic.begin(), magic.end(), bytes.begin() + int64_t(offset),
                      [](char a, uint8_t b) { return uint8_t(a) == b; });
}

}  // namespace

bool hasJpegEnd(std::span<const uint8_t> bytes) {
    static constexpr uint8_t endOfImage[] = {0xff, 0xd9};
    return std::find_end(bytes.begin(), bytes.end(), std::begin(endOfImage), std::end(endOfImage)) != bytes.end();
}

bool isWebp(std::span<const uint8_t> bytes) {
    return startsWith(bytes, "RIFF") && startsWith(bytes, "WEBP", 8);
}

std::string adviceFor(std::span<const uint8_t> bytes) {
    if (startsWith(bytes, "\xabKTX 20\xbb"))
        return ", but KTX2: store it as PNG (KTX-Software: ktx extract --transcode rgba8 IN.ktx2 OUT.png)";
    for (const auto& [magic, offset, format] :
         {std::tuple{"DDS ", 0, "DDS"}, {"ftypavif", 4, "AVIF"}, {"GIF8", 0, "GIF"}, {"BM", 0, "BMP"}})
        if (startsWith(bytes, magic, size_t(offset))) return fmt::format(", but {}: store it as PNG or JPEG", format);
    return "";
}

bool isJpeg(std::span<const uint8_t> bytes) {
    return bytes.size() > 3 && bytes[0] == 0xff && bytes[1] == 0xd8 && bytes[2] == 0xff;
}

bool isPng(std::span<const uint8_t> bytes) {
    static constexpr uint8_t magic[] = {0x89, 'P', 'N', 'G', 0x0d, 0x0a, 0x1a, 0x0a};
    return bytes.size() > sizeof magic && std::equal(std::begin(magic), std::end(magic), bytes.begin());
}

void checkIntegrity(std::span<const uint8_t> bytes, const std::string& name) {
    if (isPng(bytes)) checkPng(bytes, name);
    if (isJpeg(bytes) && !hasJpegEnd(bytes)) throw Error("{}: is broken or truncated: its end is missing", name);
}

}  // namespace voxray
