#pragma once

#include "vulkan/program.h"

/// What a shader declares, read from its SPIR-V. Internal to the vulkan layer.
namespace voxray {

/// Fills in bindings, push-constant size and specialization ids of a module from its SPIR-V.
/// @throws Error naming the module for a binding that Voxray doesn't support.
void reflect(ShaderModule& module);

}  // namespace voxray
