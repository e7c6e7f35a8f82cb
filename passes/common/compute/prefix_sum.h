#pragma once

#include "vulkan/commands.h"
#include "vulkan/program.h"

namespace voxray {

/// Exclusive prefix sum of the set bits in a list of words, on the device.
class PopulationPrefixSum {
 public:
    PopulationPrefixSum(Device& device, const ShaderCompiler& compiler);

    /// Writes to before[i] the number of bits set in words[0 .. i). @return the number of bits set in all
    /// (waits for the device). `words` and `before` hold `count` uints; sums must stay below 2^32.
    uint32_t run(CommandStream& stream, const Buffer& words, const Buffer& before, uint32_t count) const;

 private:
    Program sumBlocks_, scanBlocks_, scanWords_;
};

}  // namespace voxray
