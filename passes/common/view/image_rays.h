#pragma once

#include "graph/pass.h"

namespace voxray {

/// Rays from the camera through low-discrepancy points of the image.
class ImageRays {
 public:
    explicit ImageRays(ProgramOwner& owner);
    /// Writes rays [first, first + count) of the frame's sequence with this seed. @param rays Ray each.
    void record(PassContext& context, const Buffer& rays, uint32_t first, uint32_t count,
                uint32_t seed) const;

 private:
    Kernel program_;
};

}  // namespace voxray
