#pragma once

#include "scene/geometry.h"
#include "trace/tracing_order.h"
#include "vulkan/commands.h"
#include "vulkan/memory.h"

namespace voxray {

/// What the shaders need to decide whether a hit on a masked triangle counts (shaders/trace/trace_types.h):
/// the triangles' texture coordinates and the alpha channels of their textures, filtered in the shader
/// exactly as the CPU does, since samplers round their weights. Buffers are empty where no triangle is
/// masked.
struct GpuAlphaMask {
    Buffer triangles;
    Buffer materials;
    Buffer texels;
};

/// @throws Error where the masked textures hold more than 2^32 texels.
GpuAlphaMask makeGpuAlphaMask(Device& device, CommandStream& stream, const SceneState& state,
                              const TracingOrder& order);

}  // namespace voxray
