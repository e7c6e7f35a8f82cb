#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace voxray {

/// Converts untrusted text, such as a file's name or a library's message, to one line that is safe to print.
/// Line breaks and tabs become spaces, or are removed at the end. Invalid UTF-8, control characters, line
/// separators and marks of writing direction are escaped as `\x1b`, byte by byte.
/// @param maxBytes longer text is truncated with "...".
std::string oneLine(std::string_view text, size_t maxBytes = std::string_view::npos);

}  // namespace voxray
