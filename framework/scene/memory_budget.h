#pragma once

#include <cstdint>

namespace voxray {

/// Bounds the memory that a file can demand: half of the machine's.
class MemoryBudget {
 public:
    /// Counts memory before its allocation. @throws Error if the total exceeds the bound
    void reserve(uint64_t count, uint64_t bytesEach);

 private:
    uint64_t reservedBytes_ = 0;
};

}  // namespace voxray
