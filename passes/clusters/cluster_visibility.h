#pragma once

#include <vector>

#include "graph/pass.h"
#include "passes/clusters/visibility_list_types.h"
#include "passes/common/voxels/voxels.h"

namespace voxray {

/// The visibility list of each patch: the targets that its rays hit, with the number of rays for each.
/// Targets are patches close by and, farther away, faces of cluster components. Rays are cosine-distributed,
/// so the fraction of rays is a form factor. GLSL: passes/clusters/visibility_list.glsl and
/// gather_patch.glsl.
struct ClusterVisibility : Resource {
    std::string indexedBy() const override { return "voxels"; }

    /// The lists of a range of patches.
    struct Chunk {
        Buffer offsets;  ///< First bit of each patch's list; then the end of the last list.
        Buffer entries;  ///< Bit-packed lists; visibility_list_types.h.
    };
    std::vector<Chunk> chunks;
    Buffer chunkAddresses;               ///< Device addresses of `offsets` and `entries` of each chunk.
    gpu::VisibilityListLayout layout{};  ///< raysPerPatch, rayBits, patchesPerChunk are set in plan().
    bool listsPatches = false;           ///< Whether targets may be patches. Set in plan().
    uint64_t entryCount = 0;             ///< Sum over all lists.
    uint32_t patchCount = 0;

    uint64_t bytes() const {
        uint64_t sum = chunkAddresses.bytes();
        for (const Chunk& chunk : chunks) sum += chunk.offsets.bytes() + chunk.entries.bytes();
        return sum;
    }
};

}  // namespace voxray
