#pragma once

#include <vector>

#include "graph/pass.h"
#include "passes/common/voxels/voxels.h"
#include "shaders/clusters/seen_types.h"

namespace voxray {

/// What each patch (a face of one of the sides in a voxel) sees: parts of clusters by their faces, and near
/// sides of voxels by theirs, each with the number of rays that met it. Rays are distributed by the cosine,
/// so rays over all rays is a form factor. GLSL: shaders/clusters/seen_types.h.
struct ClusterVisibility : Resource {
    std::string basisPort() const override { return "voxels"; }

    /// Faces one after another, and what they see.
    struct Chunk {
        Buffer faces;        ///< Numbers of faces: 6 * side + (+x -x +y -y +z -z), ascending.
        Buffer first;        ///< Where each begins in `seen`, and where the last one ends.
        Buffer seen;         ///< A uint each: gpu::seenTarget() and gpu::seenRays(), by target.
        uint32_t count = 0;  ///< Faces.
    };
    std::vector<Chunk> chunks;
    uint32_t rays = 0;         ///< From each face; known from plan() on.
    bool seesVoxels = false;   ///< Whether any target may be a face of a side; known from plan() on.
    uint32_t sideTargets = 0;  ///< Targets from here on are faces of sides, before it those of parts.
    uint64_t version = 0;      ///< Another one whenever the lists are.

    uint64_t bytes() const {
        uint64_t sum = 0;
        for (const Chunk& chunk : chunks)
            sum += chunk.faces.bytes() + chunk.first.bytes() + chunk.seen.bytes();
        return sum;
    }
};

}  // namespace voxray
