#pragma once

#include <functional>

#include "scene/scene.h"

namespace voxray {

/// A spot of KHR_lights_punctual with the power of another renderer's, whose intensity falls off otherwise.
/// @param intensity on the axis, W/sr. @param inner up to this angle from the axis it is constant, radians
/// @param outer from this angle on it is 0. @param falloff intensity at an angle over that on the axis
Light spotOfEqualPower(const glm::vec3& intensity, double inner, double outer,
                       const std::function<double(double angle)>& falloff);

}  // namespace voxray
