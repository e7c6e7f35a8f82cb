#pragma once

#include <vector>

#include "graph/pass.h"
#include "passes/clusters/visibility_list_types.h"
#include "passes/common/voxels/voxels.h"

namespace voxray {

/// The visibility list of each patch: the component faces, and the patches near by, that its rays hit, with
/// the number of rays for each. Rays are cosine-distributed, so their fraction is a form factor. GLSL:
/// passes/clusters/visibility_list.glsl and gather_patch.glsl.
struct ClusterVisibility : Resource {
    std::string indexedBy() const override { return "voxels"; }

    /// The lists of consecutive patches.
    struct Chunk {
        Buffer offsets;  ///< By patch: its first entry; then the end of the last list.
        Buffer entries;  ///< `layout.entryBits` each, sorted by target; gpu::entryTarget(), entryRays().
    };
    std::vector<Chunk> chunks;
    Buffer chunkAddresses;               ///< By chunk: those of `offsets` and `entries`.
    gpu::VisibilityListLayout layout{};  ///< raysPerPatch, rayBits, patchesPerChunk are set in plan().
    bool listsPatches = false;           ///< Whether targets may be patches. Set in plan().
    uint64_t entryCount = 0;             ///< Of all lists.
    uint32_t patchCount = 0;

    uint64_t bytes() const {
        uint64_t sum = chunkAddresses.bytes();
        for (const Chunk& chunk : chunks) sum += chunk.offsets.bytes() + chunk.entries.bytes();
        return sum;
    }
};

}  // namespace voxray
