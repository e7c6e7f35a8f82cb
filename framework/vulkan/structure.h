#pragma once

#include <vulkan/vulkan.h>

namespace voxray {

/// A Vulkan structure of a type, all else zero: structure<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_..., next).
template <typename T>
T structure(VkStructureType type, void* next = nullptr) {
    T result{};
    result.sType = type;
    result.pNext = next;
    return result;
}

}  // namespace voxray
