#pragma once

#include "vulkan/commands.h"
#include "vulkan/kernel.h"

namespace voxray {

/// Counts how often each value occurs, on the device.
class Histogram {
 public:
    explicit Histogram(ProgramOwner& owner) : count_(owner, "histogram.comp") {}

    /// Writes to counts[b] how many of the first `count` uints of `values` are b, for b in [0, bins). Larger
    /// values are ignored. @param counts `bins` uints.
    void record(CommandStream& stream, const Buffer& values, const Buffer& counts, uint32_t count,
                uint32_t bins) const {
        stream.fill(counts, 0);
        stream.dispatch(count_, count, {{"values", values}, {"counts", counts}, {"count", count}, {"bins", bins}});
    }

 private:
    Kernel count_;
};

}  // namespace voxray
