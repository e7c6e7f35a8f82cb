#pragma once

#include "vulkan/commands.h"
#include "vulkan/program.h"

namespace voxray {

/// Counts how often each number occurs, on the device.
class Histogram {
 public:
    Histogram(Device& device, const ShaderCompiler& compiler);

    /// Writes to counts[b] how many of `count` uints in `values` are b, for b in [0, bins); others are not
    /// counted. `counts` holds `bins` uints.
    void record(CommandStream& stream, const Buffer& values, const Buffer& counts, uint32_t count,
                uint32_t bins) const;

 private:
    Program count_;
};

}  // namespace voxray
