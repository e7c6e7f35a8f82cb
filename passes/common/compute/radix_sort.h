#pragma once

#include "passes/common/compute/prefix_sum.h"

namespace voxray {

/// Sorts pairs of a key and a value (uints) by key on the device, ascending and stable: values of equal keys
/// keep their order. The result is the same on every device.
class RadixSort {
 public:
    explicit RadixSort(ProgramOwner& owner);

    /// Sorts in place the first `count` pairs; keeps what it takes for the next call with as many. @param
    /// keyBits bits of the keys that may be set, 1 to 32: fewer take fewer passes. @throws Error for more
    /// pairs than 32768 blocks of 4096.
    void record(CommandStream& stream, Buffer& keys, Buffer& values, uint32_t count, uint32_t keyBits = 32);

 private:
    PrefixSum prefixSum_;
    Kernel count_, scatter_;
    Buffer otherKeys_, otherValues_, counts_, blockSums_;
};

}  // namespace voxray
