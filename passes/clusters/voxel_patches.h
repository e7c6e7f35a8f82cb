#pragma once

#include "graph/pass.h"
#include "passes/clusters/patch_types.h"
#include "passes/common/compute/large_buffer.h"
#include "passes/common/voxels/voxels.h"

namespace voxray {

/// The surfaces of each voxel, split into sides: each holds those surfels that look into the same space, open
/// or a gap narrower than a voxel. Both sides of a wall that is thinner than a voxel are two. Those of a
/// side's six faces at which it has area are its patches, numbered by side and face. Clusters are split
/// likewise, into parts (find_patches).
struct VoxelPatches : Resource {
    std::string basisPort() const override { return "voxels"; }

    uint32_t sideCount = 0;
    uint32_t patchCount = 0;
    uint32_t surfelCount = 0;
    uint32_t partCount = 0;
    LargeBuffer surfels;     ///< gpu::PatchSurfel each, by voxel, side and id.
    LargeBuffer places;      ///< Of each surfel by its number: where it is in `surfels`, or NO_SIDE.
    Buffer firstSide;        ///< By voxel: its first side, and the end of the last one's; voxels + 1 uints.
    Buffer sides;            ///< gpu::SurfaceSide each.
    LargeBuffer materials;   ///< By side: PackedVoxelMaterial of its surfaces alone.
    Buffer firstNeighbour;   ///< By side: where its neighbours begin; sides + 1 uints.
    LargeBuffer neighbours;  ///< Sides of the 26 voxels round it that look into the same space, or NO_SIDE.
    Buffer parts;            ///< gpu::ClusterPart each.
    Buffer members;          ///< Sides, those of each part together and ascending.
    Buffer ofSide;           ///< By side: its part, or NO_PART where its voxel has no cluster.
    /// Where surfaces have moved since the build before: by side its number then, or NO_SIDE where its
    /// voxel has changed since. Empty where all is new.
    Buffer previousSides;

    /// Frees the buffers.
    void clear() {
        surfels = {}, places = {}, firstSide = {}, sides = {}, materials = {}, firstNeighbour = {};
        neighbours = {}, parts = {}, members = {}, ofSide = {}, previousSides = {};
    }
    uint64_t bytes() const {
        return surfels.bytes() + places.bytes() + firstSide.bytes() + sides.bytes() + materials.bytes() +
               firstNeighbour.bytes() + neighbours.bytes() + parts.bytes() + members.bytes() +
               ofSide.bytes() + previousSides.bytes();
    }
    std::vector<const Buffer*> checkedBuffers() const override { return {&materials}; }
};

}  // namespace voxray
