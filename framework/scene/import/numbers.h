#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace voxray {

/// Reads a number at the front of a text and removes it; nullopt: there is none. "inf" and "nan" are none.
inline std::optional<double> takeNumber(std::string_view& text) {
    const size_t sign = text.starts_with('+') ? 1 : 0;
    double value = 0;
    const auto [end, code] = std::from_chars(text.data() + sign, text.data() + text.size(), value);
    if (code != std::errc() || !std::isfinite(value)) return {};
    text.remove_prefix(size_t(end - text.data()));
    return value;
}

/// Numbers between spaces or commas. @throws Error for anything else
inline std::vector<double> readNumbers(std::string_view text) {
    constexpr std::string_view spaces = " \t\r\n\v\f,;";
    std::vector<double> numbers;
    while (true) {
        text.remove_prefix(std::min(text.find_first_not_of(spaces), text.size()));
        if (text.empty()) return numbers;
        const std::string_view rest = text;
        const std::optional<double> number = takeNumber(text);
        if (!number || (!text.empty() && spaces.find(text.front()) == std::string_view::npos))
            throw Error("'{}' is no number", rest.substr(0, std::min<size_t>(rest.find_first_of(spaces), 40)));
        numbers.push_back(*number);
    }
}

}  // namespace voxray
