#pragma once

#include <vector>

#include "graph/pass.h"
#include "shaders/view/gather_types.h"

namespace voxray {

/// Where the gather rays of a frame hit. The G-buffer's texels fall into blocks; each block owns
/// `raysPerBlock` rays, spread over its texels and over their hemispheres by cosine
/// (shaders/view/gather_layout.glsl). Rays are stored block by block, in batches of whole blocks.
struct GatherHits : Resource {
    gpu::GatherLayout layout{};
    uint32_t blocksPerBatch = 0;
    std::vector<Buffer> batches;  ///< Hit a ray.

    uint32_t blocks() const { return layout.blocks.x * layout.blocks.y; }
    /// Blocks of batch `b`.
    uint32_t batchBlocks(uint32_t b) const {
        const uint32_t first = b * blocksPerBatch;
        return blocks() - first < blocksPerBatch ? blocks() - first : blocksPerBatch;
    }
};

}  // namespace voxray
