#include "vulkan/allocate.h"

#include <bit>
#include <optional>

#include "base/byte_units.h"
#include "vulkan/memory_pool.h"
#include "vulkan/size_error.h"
#include "vulkan/structure.h"

namespace voxray {
namespace {

constexpr VkMemoryPropertyFlags kHost = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;

bool sharesMemory(const Device& device) {
    return device.properties().deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU ||
           device.properties().deviceType == VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU;
}

/// The first allowed memory type with all flags of `needed` and most of `preferred`.
std::optional<uint32_t> findType(const Device& device, uint32_t allowed, VkMemoryPropertyFlags needed,
                                 VkMemoryPropertyFlags preferred) {
    const VkPhysicalDeviceMemoryProperties& memory = device.memoryProperties();
    std::optional<uint32_t> best;
    int bestScore = -1;
    for (uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
        const VkMemoryPropertyFlags flags = memory.memoryTypes[i].propertyFlags;
        const int score = std::popcount(flags & preferred);
        if (!(allowed & (1u << i)) || (flags & needed) != needed || score <= bestScore) continue;
        best = i;
        bestScore = score;
    }
    return best;
}

}  // namespace

bool isMapped(const Device& device, MemoryKind kind) {
    return kind != MemoryKind::Device || sharesMemory(device);
}

DeviceMemory allocateMemory(Device& device, const std::string& name, const VkMemoryRequirements& requirements,
                            MemoryKind kind, bool addressable) {
    const uint64_t limit = device.limits().allocationBytes;
    if (requirements.size > limit)
        throw SizeError("'{}' needs {:.1f} MiB; device '{}' allows {:.1f} MiB in one allocation", name,
                        double(requirements.size) / kMiB, device.info().name, double(limit) / kMiB);

    // Memory type: mapped if the host needs or shares it, cached for reading back.
    const VkMemoryPropertyFlags needed = isMapped(device, kind) ? kHost : 0;
    VkMemoryPropertyFlags preferred = 0;
    if (kind != MemoryKind::Upload) preferred |= VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
    if (kind == MemoryKind::Device) preferred = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
    const std::optional<uint32_t> type = findType(device, requirements.memoryTypeBits, needed, preferred);
    if (!type) throw Error("device '{}' has no memory type for '{}'", device.info().name, name);

    // Checks the memory limit before the driver is called.
    device.reserveMemory(requirements.size, name);
    MemoryPool& pool = device.memoryPool();
    if (const auto memory = pool.acquire(requirements.size, *type, addressable)) return *memory;
    auto flags = structure<VkMemoryAllocateFlagsInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO);
    flags.flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT;
    auto allocate =
        structure<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, addressable ? &flags : nullptr);
    allocate.allocationSize = requirements.size;
    allocate.memoryTypeIndex = *type;
    DeviceMemory memory{VK_NULL_HANDLE, requirements.size, *type, addressable};
    VkResult result = vkAllocateMemory(device.handle(), &allocate, nullptr, &memory.handle);
    if (result != VK_SUCCESS && pool.bytes() > 0) {
        pool.freeAll();
        result = vkAllocateMemory(device.handle(), &allocate, nullptr, &memory.handle);
    }
    if (result != VK_SUCCESS) {
        device.releaseMemory(requirements.size, name);
        throw SizeError("device '{}' refused {:.1f} MiB for '{}' ({})", device.info().name,
                        double(requirements.size) / kMiB, name, int(result));
    }
    return memory;
}

void freeMemory(Device& device, const std::string& name, const DeviceMemory& memory) {
    device.memoryPool().recycle(memory);
    device.releaseMemory(memory.bytes, name);
}

}  // namespace voxray
