#include "vulkan/spare_memory.h"

#include <algorithm>

namespace voxray {

std::optional<DeviceMemory> SpareMemory::take(uint64_t bytes, uint32_t type, bool addressable) {
    const std::lock_guard lock(mutex_);
    const auto fits = [&](const DeviceMemory& memory) {
        return memory.bytes == bytes && memory.type == type && memory.addressable == addressable;
    };
    const auto newest = std::ranges::find_if(spare_.rbegin(), spare_.rend(), fits);
    if (newest == spare_.rend()) return std::nullopt;
    const DeviceMemory memory = *newest;
    spare_.erase(std::prev(newest.base()));
    bytes_ -= memory.bytes;
    return memory;
}

void SpareMemory::keep(const DeviceMemory& memory) {
    const std::lock_guard lock(mutex_);
    spare_.push_back(memory);
    bytes_ += memory.bytes;
    while (bytes_ > largestBytes_) freeOldest();
}

void SpareMemory::freeAll() {
    const std::lock_guard lock(mutex_);
    while (!spare_.empty()) freeOldest();
}

uint64_t SpareMemory::bytes() const {
    const std::lock_guard lock(mutex_);
    return bytes_;
}

void SpareMemory::freeOldest() {
    vkFreeMemory(device_, spare_.front().handle, nullptr);
    bytes_ -= spare_.front().bytes;
    spare_.pop_front();
}

}  // namespace voxray
