#pragma once

#include "passes/common/compute/prefix_sum.h"

namespace voxray {

/// Lists the items of an array that are flagged, on the device.
class Compaction {
 public:
    explicit Compaction(ProgramOwner& owner);

    /// Writes the indices of the flagged items, in ascending order, to the first words of `indices`.
    /// @param flags a bit an item: of item i, bit i % 32 of word i / 32; bits after the last item are 0.
    /// @param indices a uint for each flagged item, or more.
    /// @param words of `flags`. @return the number of flagged items; waits for the device.
    uint32_t run(CommandStream& stream, const Buffer& flags, const Buffer& indices, uint32_t words) const;

 private:
    PrefixSum prefixSum_;
    Kernel list_;
};

}  // namespace voxray
