#pragma once

#include <glm/mat4x4.hpp>
#include <map>
#include <string>

#include "base/error.h"

namespace voxray::mitsuba {

/// Attributes of an element: name -> text.
using Attributes = std::map<std::string, std::string>;

/// The matrix of an element of a <transform>: translate, rotate, scale, lookat or matrix.
/// @throws Error for another one, numbers that are none, and a view along its own up vector
glm::dmat4 transformOf(const std::string& element, const Attributes& of, const TextLocation& where);

}  // namespace voxray::mitsuba
