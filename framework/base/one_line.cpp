#include "base/one_line.h"

#include <fmt/format.h>

#include <cstdint>

namespace voxray {
namespace {

struct Character {
    size_t bytes;         ///< 1 for invalid UTF-8.
    uint32_t code;        ///< Code point.
    bool isValid = true;  ///< Not truncated, overlong, a surrogate or past the last code point.
};

/// The first character of a nonempty text.
Character firstCharacter(std::string_view text) {
    const auto byteAt = [&](size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned char lead = byteAt(0);
    if (lead < 0x80) return {1, lead};
    const size_t bytes = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
    const Character broken{1, lead, false};
    if (lead < 0xc2 || lead > 0xf4 || text.size() < bytes) return broken;
    uint32_t code = lead & (0x7fu >> bytes);
    for (size_t i = 1; i < bytes; ++i) {
        if ((byteAt(i) & 0xc0) != 0x80) return broken;
        code = code << 6 | (byteAt(i) & 0x3f);
    }
    constexpr uint32_t kFirstOfLength[] = {0x80, 0x800, 0x10000};
    const bool isSurrogate = code >= 0xd800 && code <= 0xdfff;
    if (code < kFirstOfLength[bytes - 2] || code > 0x10ffff || isSurrogate) return broken;
    return {bytes, code};
}

/// Unicode control characters, line separators and marks of writing direction.
bool isControl(uint32_t code) {
    const auto within = [&](uint32_t first, uint32_t last) { return code >= first && code <= last; };
    return code < 0x20 || within(0x7f, 0x9f) || code == 0x61c || within(0x200e, 0x200f) || within(0x2028, 0x202e) ||
           within(0x2066, 0x2069) || code == 0xfeff;
}

bool isSpace(char c) {
    return c == ' ' || c == '\n' || c == '\r' || c == '\t';
}

}  // namespace

size_t utf8Length(std::string_view text) {
    const Character c = firstCharacter(text);
    return c.isValid ? c.bytes : 0;
}

std::string oneLine(std::string_view text, size_t maxBytes) {
    while (!text.empty() && isSpace(text.back())) text.remove_suffix(1);
    constexpr std::string_view kDots = "...";
    std::string line;
    size_t cutAt = 0;  // Length of the line if truncated, such that the dots fit.
    while (!text.empty()) {
        const Character c = firstCharacter(text);
        const std::string_view bytes = text.substr(0, c.bytes);
        if (isSpace(text[0]))
            line += ' ';
        else if (c.isValid && !isControl(c.code))
            line += bytes;
        else
            for (const char byte : bytes) line += fmt::format("\\x{:02x}", static_cast<unsigned char>(byte));
        if (line.size() > maxBytes) return line.substr(0, cutAt).append(kDots);
        if (line.size() + kDots.size() <= maxBytes) cutAt = line.size();
        text.remove_prefix(c.bytes);
    }
    return line;
}

}  // namespace voxray
