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

/// Bytes of the first character of a nonempty UTF-8 text; 0 if it is invalid. Source: RFC 3629, section 3.
size_t utf8Length(std::string_view text);

}  // namespace voxray
