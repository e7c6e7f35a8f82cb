#pragma once

#include "vulkan/commands.h"
#include "vulkan/kernel.h"

namespace voxray {

/// Exclusive prefix sum on the device, of uints or of the numbers of bits set in them.
class PrefixSum {
 public:
    /// What is summed: the source's uints, or the number of bits set in each.
    enum class Input { Uints, SetBits };
    PrefixSum(ProgramOwner& owner, Input input);

    /// Writes to before[i] the sum over source[0 .. i). Both buffers hold `count` uints and may be the same.
    /// The sum of all must be below 2^32. @return the sum of all; waits for the device.
    uint32_t run(CommandStream& stream, const Buffer& source, const Buffer& before, uint32_t count) const;

    /// The same without waiting. @param blockSums scratch of scratchBytes(count); the sum of all is its last
    /// uint.
    void record(CommandStream& stream, const Buffer& source, const Buffer& before, const Buffer& blockSums,
                uint32_t count) const;
    static uint64_t scratchBytes(uint32_t count);
    /// The sum of all, from the scratch of record(); waits for the device.
    static uint32_t sum(CommandStream& stream, const Buffer& blockSums);

 private:
    Kernel sumBlocks_, scanBlocks_, scanValues_;
};

}  // namespace voxray
