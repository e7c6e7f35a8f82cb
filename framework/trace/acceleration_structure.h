#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <vector>

#include "scene/geometry.h"
#include "trace/tracing_order.h"
#include "vulkan/commands.h"
#include "vulkan/memory.h"

namespace voxray {

/// vkDestroyAccelerationStructureKHR, which is a function of an extension.
void destroyAccelerationStructure(VkDevice device, VkAccelerationStructureKHR structure,
                                  const VkAllocationCallbacks* allocator);

/// A Vulkan acceleration structure with its memory. Move-only.
class AccelerationStructure {
 public:
    AccelerationStructure() = default;
    AccelerationStructure(Device& device, const char* name, VkAccelerationStructureTypeKHR type, uint64_t bytes);

    VkAccelerationStructureKHR handle() const { return handle_; }
    VkDeviceAddress address() const { return address_; }
    uint64_t bytes() const { return buffer_.bytes(); }

 private:
    Buffer buffer_;
    UniqueHandle<VkAccelerationStructureKHR, destroyAccelerationStructure> handle_;
    VkDeviceAddress address_ = 0;
};

/// Acceleration structures of a scene: chunks of opaque and of alpha-masked triangles, each a bottom-level
/// structure with an instance whose custom index is the chunk's number. Opaque chunks call no any-hit shader.
struct SceneStructure {
    std::vector<AccelerationStructure> chunks;
    AccelerationStructure top;
    Buffer chunkFirst;   ///< First triangle, in tracing order, of each chunk.
    Buffer triangleIds;  ///< Triangles of the scene, in tracing order.
    Buffer corners;      ///< Vertices of the triangles, in tracing order.
    Buffer positions;    ///< Positions of the vertices.
    uint32_t opaqueCount = 0;

    uint64_t bytes() const;  ///< Memory of all structures.
};

/// Maximum number of triangles in a bottom-level structure.
uint32_t trianglesPerChunk(const Device& device);

/// Builds the structures and waits. @throws Error over the memory limit.
SceneStructure buildSceneStructure(Device& device, CommandStream& stream, const SceneState& state,
                                   const TracingOrder& order);

/// Rebuilds the chunks of moving triangles and the top-level structure in place and waits. After
/// `sortMoving`.
void updateSceneStructure(Device& device, CommandStream& stream, const SceneState& state, const TracingOrder& order,
                          SceneStructure& scene);

}  // namespace voxray
