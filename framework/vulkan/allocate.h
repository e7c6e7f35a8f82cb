#pragma once

#include <vulkan/vulkan.h>

#include <string>

#include "vulkan/memory.h"

/// Device memory, one allocation a resource. Internal to the vulkan layer.
namespace voxray {

/// Most bytes of one buffer.
uint64_t maxBufferBytes(const Device& device);

/// Whether memory of this kind is mapped for the host.
bool isMapped(const Device& device, MemoryKind kind);

/// Books and allocates memory. `addressable`: with a device address.
/// @throws SizeError naming the resource where it is too large, the limit is reached or the driver refuses.
VkDeviceMemory allocateMemory(Device& device, const std::string& name,
                              const VkMemoryRequirements& requirements, MemoryKind kind, bool addressable);

/// Frees memory and takes it off the books.
void freeMemory(Device& device, const std::string& name, VkDeviceMemory memory, uint64_t bytes);

}  // namespace voxray
