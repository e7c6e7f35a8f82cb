#pragma once

#include <vulkan/vulkan.h>

#include <string>

#include "vulkan/memory.h"

/// Device memory, one allocation per resource. Internal to the vulkan layer.
namespace voxray {

/// Whether memory of this kind is mapped for the host.
bool isMapped(const Device& device, MemoryKind kind);

/// Allocates memory and counts it as used; takes it from the pool if possible. `addressable`: with a device
/// address. @throws SizeError naming the resource if it is too large, the limit is reached or the driver
/// refuses.
DeviceMemory allocateMemory(Device& device, const std::string& name, const VkMemoryRequirements& requirements,
                            MemoryKind kind, bool addressable);

/// Returns memory, which must not be mapped, to the pool; it no longer counts as used.
void freeMemory(Device& device, const std::string& name, const DeviceMemory& memory);

}  // namespace voxray
