#include "base/hex_color.h"

#include <fmt/format.h>

#include <charconv>

#include "base/srgb.h"

namespace voxray {

std::string linearTriple(std::string_view hexColor) {
    if (!hexColor.starts_with('#') || (hexColor.size() != 4 && hexColor.size() != 7)) return {};
    const size_t width = hexColor.size() / 3;  // Digits of a channel.
    double linear[3];
    for (size_t c = 0; c < 3; ++c) {
        const std::string_view digits = hexColor.substr(1 + c * width, width);
        unsigned value = 0;
        const auto [end, code] = std::from_chars(digits.data(), digits.data() + width, value, 16);
        if (code != std::errc() || end != digits.data() + width) return {};
        linear[c] = srgbDecode(value / (width == 1 ? 15.0 : 255.0));
    }
    return fmt::format("[{:.4g}, {:.4g}, {:.4g}]", linear[0], linear[1], linear[2]);
}

}  // namespace voxray
