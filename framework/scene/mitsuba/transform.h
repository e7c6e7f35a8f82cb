#pragma once

#include "scene/mitsuba/plugin.h"

namespace voxray::mitsuba {

/// The matrix of an element of a <transform>: translate, rotate, scale, lookat or matrix.
/// @throws Error for another one, numbers that are none, and a view along its own up vector
glm::dmat4 transformOf(const std::string& element, const Attributes& of, const TextLocation& where);

}  // namespace voxray::mitsuba
