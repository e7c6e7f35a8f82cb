#pragma once

#include "vulkan/commands.h"
#include "vulkan/kernel.h"

namespace voxray {

/// Exclusive prefix sum of a list of uints on the device, or of the numbers of bits set in them.
class PrefixSum {
 public:
    enum class Of { Values, SetBits };
    PrefixSum(ProgramOwner& owner, Of of);

    /// Writes to before[i] the sum over source[0 .. i). `source` and `before` hold `count` uints and may be
    /// the same buffer; the sum of all must stay below 2^32. @return the sum of all; waits for the device.
    uint32_t run(CommandStream& stream, const Buffer& source, const Buffer& before, uint32_t count) const;

    /// The same without waiting. @param blockSums scratchBytes(count) of scratch; its last uint is the sum of
    /// all.
    void record(CommandStream& stream, const Buffer& source, const Buffer& before, const Buffer& blockSums,
                uint32_t count) const;
    static uint64_t scratchBytes(uint32_t count);

 private:
    Kernel sumBlocks_, scanBlocks_, scanValues_;
};

}  // namespace voxray
