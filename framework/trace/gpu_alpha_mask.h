#pragma once

#include "scene/geometry.h"
#include "trace/tracing_order.h"
#include "vulkan/commands.h"
#include "vulkan/memory.h"

namespace voxray {

/// Data of the any-hit test of alpha-masked triangles (shaders/trace/trace_types.h): texture coordinates, and
/// alpha channels of textures. Shaders filter these exactly as the CPU does, since samplers round their
/// weights. Buffers are empty if no triangle is masked.
struct GpuAlphaMask {
    Buffer triangles;
    Buffer materials;
    Buffer texels;
};

/// @throws Error if the masked textures have more than 2^32 texels.
GpuAlphaMask makeGpuAlphaMask(Device& device, CommandStream& stream, const SceneState& state,
                              const TracingOrder& order);

}  // namespace voxray
