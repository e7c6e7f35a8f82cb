#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace voxray {

/// Text of any origin, such as a file's name or a library's message, as one line that is safe to print. Line
/// breaks and tabs become spaces, those at the end go. Bytes that are no UTF-8, control characters, and
/// characters that break lines or turn the direction of writing are written as `\x1b`, byte by byte.
/// @param maxBytes what is longer ends in "..." before that many bytes.
std::string oneLine(std::string_view text, size_t maxBytes = std::string_view::npos);

}  // namespace voxray
