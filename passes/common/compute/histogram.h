#pragma once

#include "vulkan/commands.h"
#include "vulkan/kernel.h"

namespace voxray {

/// Counts how often each number occurs, on the device.
class Histogram {
 public:
    explicit Histogram(ProgramOwner& owner) : count_(owner, "histogram.comp") {}

    /// Writes to counts[b] how many of `count` uints in `values` are b, for b in [0, bins); others are not
    /// counted. `counts` holds `bins` uints.
    void record(CommandStream& stream, const Buffer& values, const Buffer& counts, uint32_t count,
                uint32_t bins) const;

 private:
    Kernel count_;
};

}  // namespace voxray
