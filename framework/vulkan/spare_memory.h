#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>

#include "vulkan/memory.h"

namespace voxray {

/// Memory of resources that are gone, for the next ones of the same size. Passes make and free their scratch
/// in each frame, and a GPU's driver takes a tenth to a whole millisecond for an allocation, longer than most
/// passes take. Spare memory is not in use: the device's books and limits know it not. What it held is still
/// there, so that nobody may count on zeros. Internal to the vulkan layer.
class SpareMemory {
 public:
    /// @param largestBytes that may be spare at once; the oldest is freed first.
    SpareMemory(VkDevice device, uint64_t largestBytes) : device_(device), largestBytes_(largestBytes) {}
    ~SpareMemory() { freeAll(); }
    SpareMemory(const SpareMemory&) = delete;
    SpareMemory& operator=(const SpareMemory&) = delete;

    /// Memory of exactly these bytes, this type and this way of use; none where none is spare.
    std::optional<DeviceMemory> take(uint64_t bytes, uint32_t type, bool addressable);
    /// Takes memory over that nobody uses any more and that isn't mapped.
    void keep(const DeviceMemory& memory);
    /// Gives all of it back to the driver.
    void freeAll();

    uint64_t bytes() const;

 private:
    void freeOldest();

    VkDevice device_;
    uint64_t largestBytes_;
    mutable std::mutex mutex_;
    std::deque<DeviceMemory> spare_;  ///< Oldest first.
    uint64_t bytes_ = 0;
};

}  // namespace voxray
