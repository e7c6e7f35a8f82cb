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

/// Books and allocates memory, spare memory of that size first. `addressable`: with a device address.
/// @throws SizeError naming the resource where it is too large, the limit is reached or the driver refuses.
DeviceMemory allocateMemory(Device& device, const std::string& name, const VkMemoryRequirements& requirements,
                            MemoryKind kind, bool addressable);

/// Takes memory, which must not be mapped, off the books and makes it spare.
void freeMemory(Device& device, const std::string& name, const DeviceMemory& memory);

}  // namespace voxray
