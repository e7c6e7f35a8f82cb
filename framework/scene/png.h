#pragma once

#include <cstdint>
#include <vector>

#include "scene/scene.h"

namespace voxray {

/// A texture as a PNG file of 8-bit RGBA, without compression (PNG 1.2, sections 3 and 4; RFC 1950, RFC
/// 1951).
std::vector<uint8_t> encodePng(const Texture& texture);

}  // namespace voxray
