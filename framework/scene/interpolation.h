#pragma once

#include <cstdint>

namespace voxray {

/// Between the keys of an animation (glTF 2.0, appendix C).
enum class Interpolation : uint32_t { Linear, Step, CubicSpline };

}  // namespace voxray
