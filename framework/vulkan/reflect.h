#pragma once

#include "vulkan/program.h"

/// Reflection of shaders. Internal to the vulkan layer.
namespace voxray {

/// Fills in bindings, push constants and specialization constants of a module from its SPIR-V.
/// @throws Error naming the module for a binding that Voxray doesn't support.
void reflect(ShaderModule& module);

}  // namespace voxray
