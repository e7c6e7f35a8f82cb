#pragma once

#include <algorithm>
#include <cctype>
#include <string>

namespace voxray {

/// The text with ASCII letters in lower case.
inline std::string lowerCase(std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    return text;
}

}  // namespace voxray
