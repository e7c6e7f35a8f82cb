#pragma once

#include <cctype>
#include <string>

#include "base/field.h"

namespace voxray {

/// A name for GLSL: the prefix and the name of an enumerator in upper case, such as MARCH_BRICKS.
template <typename E>
std::string enumDefine(std::string prefix, E value) {
    for (const char letter : enumName(value)) prefix += char(std::toupper(letter));
    return prefix;
}

}  // namespace voxray
