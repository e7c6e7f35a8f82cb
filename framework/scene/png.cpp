#include "scene/png.h"

#include <algorithm>
#include <array>
#include <string_view>

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

void appendU32(std::vector<uint8_t>& out, uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8) out.push_back(uint8_t(value >> shift));
}

/// Length, type, data, and the checksum of type and data.
void appendChunk(std::vector<uint8_t>& out, std::string_view type, const std::vector<uint8_t>& data) {
    appendU32(out, uint32_t(data.size()));
    const size_t begin = out.size();
    out.insert(out.end(), type.begin(), type.end());
    out.insert(out.end(), data.begin(), data.end());
    uint32_t crc = 0xffffffffu;
    for (size_t i = begin; i < out.size(); ++i) crc = crcTable[(crc ^ out[i]) & 0xff] ^ (crc >> 8);
    appendU32(out, ~crc);
}

/// A zlib stream of stored blocks.
std::vector<uint8_t> store(const std::vector<uint8_t>& data) {
    constexpr size_t blockBytes = 65535;
    std::vector<uint8_t> out{0x78, 0x01};
    for (size_t begin = 0; begin < data.size(); begin += blockBytes) {
        const size_t size = std::min(blockBytes, data.size() - begin);
        const uint8_t last = begin + size == data.size() ? 1 : 0;
        const uint8_t low = uint8_t(size & 0xff);
        const uint8_t high = uint8_t(size >> 8);
        out.insert(out.end(), {last, low, high, uint8_t(~low), uint8_t(~high)});
        out.insert(out.end(), data.begin() + std::ptrdiff_t(begin),
                   data.begin() + std::ptrdiff_t(begin + size));
    }
    uint32_t a = 1;
    uint32_t b = 0;
    for (const uint8_t byte : data) {
        a = (a + byte) % 65521;
        b = (b + a) % 65521;
    }
    appendU32(out, b << 16 | a);
    return out;
}

}  // namespace

std::vector<uint8_t> encodePng(const Texture& texture) {
    // 8 bits a channel, RGBA, no filter.
    std::vector<uint8_t> header;
    appendU32(header, texture.width);
    appendU32(header, texture.height);
    header.insert(header.end(), {8, 6, 0, 0, 0});
    const size_t rowBytes = size_t(texture.width) * 4;
    std::vector<uint8_t> rows;
    rows.reserve((rowBytes + 1) * texture.height);
    for (size_t y = 0; y < texture.height; ++y) {
        const auto row = texture.rgba.begin() + std::ptrdiff_t(y * rowBytes);
        rows.push_back(0);
        rows.insert(rows.end(), row, row + std::ptrdiff_t(rowBytes));
    }
    std::vector<uint8_t> png{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    appendChunk(png, "IHDR", header);
    appendChunk(png, "IDAT", store(rows));
    appendChunk(png, "IEND", {});
    return png;
}

}  // namespace voxray
