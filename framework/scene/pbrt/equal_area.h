#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "image/image.h"

/// The equal-area mapping between unit vectors and the unit square that pbrt's environment maps have: octahedral, +Z
/// in the center, -Z in the corners. Source: Clarberg 2008, Fast Equal-Area Mapping of the (Hemi)Sphere using SIMD.
namespace voxray::pbrt {

/// @param direction unit length
glm::dvec2 squareOfDirection(const glm::dvec3& direction);
/// @param uv 0 to 1
glm::dvec3 directionOfSquare(const glm::dvec2& uv);

/// The texel of a map in a direction.
glm::vec3 texelAlong(const ImageF& map, const glm::dvec3& direction);

}  // namespace voxray::pbrt
