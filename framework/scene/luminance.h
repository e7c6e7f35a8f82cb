#pragma once

#include <glm/vec3.hpp>

namespace voxray {

/// Luminance of linear Rec. 709 (sRGB primaries), in the unit of `c`.
inline float luminance(const glm::vec3& c) {
    return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z;
}

}  // namespace voxray
