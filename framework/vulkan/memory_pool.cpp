#include "vulkan/memory_pool.h"

#include <algorithm>

namespace voxray {

std::optional<DeviceMemory> MemoryPool::acquire(uint64_t bytes, uint32_t type, bool addressable) {
    const auto fits = [&](const DeviceMemory& memory) {
        return memory.bytes == bytes && memory.type == type && memory.addressable == addressable;
    };
    const auto newest = std::ranges::find_if(allocations_.rbegin(), allocations_.rend(), fits);
    if (newest == allocations_.rend()) return std::nullopt;
    const DeviceMemory memory = *newest;
    allocations_.erase(std::prev(newest.base()));
    bytes_ -= memory.bytes;
    return memory;
}

void MemoryPool::recycle(const DeviceMemory& memory) {
    allocations_.push_back(memory);
    bytes_ += memory.bytes;
    while (bytes_ > maxBytes_) freeOldest();
}

void MemoryPool::freeAll() {
    while (!allocations_.empty()) freeOldest();
}

void MemoryPool::freeOldest() {
    vkFreeMemory(device_, allocations_.front().handle, nullptr);
    bytes_ -= allocations_.front().bytes;
    allocations_.pop_front();
}

}  // namespace voxray
