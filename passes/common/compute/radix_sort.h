#pragma once

#include "passes/common/compute/large_buffer.h"
#include "passes/common/compute/prefix_sum.h"

namespace voxray {

/// Sorts pairs of a key and a value (uints) by ascending key, on the device. Stable: values of equal keys
/// keep their order, so that the result is the same on every device.
class RadixSort {
 public:
    explicit RadixSort(ProgramOwner& owner);

    /// Sorts the first `count` pairs in place. Its scratch remains allocated for the next call, until
    /// freeScratch(). @param keyBits significant bits of keys, 1 to 32: fewer need fewer passes.
    /// @throws Error for more than 2^27 pairs.
    void record(CommandStream& stream, Buffer& keys, Buffer& values, uint32_t count, uint32_t keyBits = 32);
    /// The stream must have finished.
    void freeScratch() { sortedKeys_ = {}, sortedValues_ = {}, counts_ = {}, blockSums_ = {}; }

 private:
    PrefixSum prefixSum_;
    Kernel count_, scatter_;
    Buffer sortedKeys_, sortedValues_, counts_, blockSums_;
};

}  // namespace voxray
