#pragma once

#include "passes/common/compute/prefix_sum.h"

namespace voxray {

/// Stream compaction: lists the flagged items of an array, on the device.
class Compaction {
 public:
    explicit Compaction(ProgramOwner& owner)
        : prefixSum_(owner, PrefixSum::Input::SetBits), list_(owner, "compaction.comp") {}

    /// Writes the indices of the flagged items, in ascending order.
    /// @param flags a bit per item: that of item i is bit i % 32 of word i / 32; bits beyond the last item
    /// are 0. @param indices a uint for each flagged item, or more.
    /// @param words of `flags`. @return the number of flagged items; waits for the device.
    uint32_t run(CommandStream& stream, const Buffer& flags, const Buffer& indices, uint32_t words) const {
        const Buffer before(stream.device(), "flagged items before", uint64_t(words) * sizeof(uint32_t));
        const Buffer sums(stream.device(), "prefix sum blocks", PrefixSum::scratchBytes(words));
        prefixSum_.record(stream, flags, before, sums, words);
        stream.dispatch(list_, words, {{"flags", flags}, {"before", before}, {"indices", indices}, {"words", words}});
        return PrefixSum::sum(stream, sums);
    }

 private:
    PrefixSum prefixSum_;
    Kernel list_;
};

}  // namespace voxray
