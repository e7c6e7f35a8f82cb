#pragma once

#include <string>
#include <string_view>

namespace voxray {

/// Linear values "[1, 0.2462, 0]" of an sRGB colour in web notation (#ff8800 or #f80); "" for other text.
std::string linearTriple(std::string_view hexColor);

}  // namespace voxray
