#pragma once

#include <vector>

#include "graph/pass.h"
#include "shaders/view/gather_types.h"

namespace voxray {

/// Hits of a frame's gather rays. Each block of the G-buffer's texels has `raysPerBlock` rays, distributed
/// over its texels and by cosine over their hemispheres (shaders/view/gather_layout.glsl). Rays are stored
/// block by block, in batches of whole blocks.
struct GatherHits : Resource {
    gpu::GatherLayout layout{};
    uint32_t blocksPerBatch = 0;
    std::vector<Buffer> batches;  ///< Hit per ray.

    uint32_t blocks() const { return layout.blocks.x * layout.blocks.y; }
    /// Blocks of batch `b`.
    uint32_t batchBlocks(uint32_t b) const {
        const uint32_t first = b * blocksPerBatch;
        return blocks() - first < blocksPerBatch ? blocks() - first : blocksPerBatch;
    }
};

}  // namespace voxray
