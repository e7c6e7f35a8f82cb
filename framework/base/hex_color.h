#pragma once

#include <string>
#include <string_view>

namespace voxray {

/// "[1, 0.2462, 0]", the linear values of a display colour as web pages write it (#ff8800 or #f80, sRGB); ""
/// for another text.
std::string linearTriple(std::string_view hexColor);

}  // namespace voxray
