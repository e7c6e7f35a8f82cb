#pragma once

#include <vulkan/vulkan.h>

namespace voxray {

/// A zero-initialized Vulkan structure: structure<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_..., next).
template <typename T>
T structure(VkStructureType type, void* next = nullptr) {
    T result{};
    result.sType = type;
    result.pNext = next;
    return result;
}

}  // namespace voxray
