#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <deque>
#include <optional>

#include "vulkan/memory.h"

namespace voxray {

/// Pool of freed allocations, reused for resources of the same size. Passes make and free their scratch in
/// each frame, and a GPU's driver takes 0.1 to 1 ms for an allocation, longer than most passes. Pooled memory
/// doesn't count as used, and keeps its old contents. Internal to the vulkan layer.
class MemoryPool {
 public:
    /// @param maxBytes in the pool; the oldest allocations are freed first.
    MemoryPool(VkDevice device, uint64_t maxBytes) : device_(device), maxBytes_(maxBytes) {}
    ~MemoryPool() { freeAll(); }
    MemoryPool(const MemoryPool&) = delete;
    MemoryPool& operator=(const MemoryPool&) = delete;

    /// An allocation of exactly this size, type and addressability, if there is one.
    std::optional<DeviceMemory> acquire(uint64_t bytes, uint32_t type, bool addressable);
    /// Adds unused memory, which must not be mapped.
    void recycle(const DeviceMemory& memory);
    /// Returns all memory to the driver.
    void freeAll();

    uint64_t bytes() const { return bytes_; }

 private:
    void freeOldest();

    VkDevice device_;
    uint64_t maxBytes_;
    std::deque<DeviceMemory> allocations_;  ///< Oldest first.
    uint64_t bytes_ = 0;
};

}  // namespace voxray
