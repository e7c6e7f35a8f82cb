#pragma once

#include <vector>

#include "graph/pass.h"
#include "passes/clusters/seen_types.h"
#include "passes/common/voxels/voxels.h"

namespace voxray {

/// What each patch sees: parts of clusters by their faces, and near patches, each with the number of rays
/// that met it. Rays are distributed by the cosine, so rays over all rays is a form factor. GLSL:
/// passes/clusters/seen_types.h and gather_patch.glsl.
struct ClusterVisibility : Resource {
    std::string basisPort() const override { return "voxels"; }

    /// What patches see that follow one another by number.
    struct Chunk {
        Buffer first;  ///< Where each patch's list begins in `seen`, and where the last one ends.
        Buffer seen;   ///< Entries of `layout.entryBits`: gpu::seenTarget() and gpu::seenRays(), by target.
    };
    std::vector<Chunk> chunks;
    Buffer addresses;           ///< Of `first` and `seen`, by chunk.
    gpu::SeenLayout layout{};   ///< Rays, their bits and patches of a chunk are known from plan() on.
    bool listsPatches = false;  ///< Whether entries name patches besides faces of parts; from plan() on.
    uint64_t entries = 0;       ///< Of all lists.
    uint32_t patchCount = 0;    ///< That have a list.

    uint64_t bytes() const {
        uint64_t sum = addresses.bytes();
        for (const Chunk& chunk : chunks) sum += chunk.first.bytes() + chunk.seen.bytes();
        return sum;
    }
};

}  // namespace voxray
