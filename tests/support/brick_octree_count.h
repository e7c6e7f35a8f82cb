#pragma once

#include <cstdint>
#include <vector>

#include "passes/common/octree/brick_octree.h"
#include "passes/common/voxels/voxel_bits.h"
#include "scene/geometry.h"
#include "shaders/voxels/voxel_types.h"

namespace voxray {

/// What a BrickOctree holds, counted on the host: all that its memory depends on.
struct BrickOctreeCount {
    struct Level {
        uint64_t opaque = 0;  ///< Nodes that surfaces pass through.
        uint64_t bricks = 0;  ///< These, and those of the 26 round each that are made to exist.
        uint64_t nodes = 0;   ///< All in the node pool: the eight children of each node with a brick above.
    };
    std::vector<Level> levels;  ///< Leaves first; the last is the root.

    uint64_t nodes() const, bricks() const;
    uint64_t bytes() const { return nodes() * kBrickNodeBytes + bricks() * kBrickBytes; }
};

/// Counts nodes and bricks. Nodes of each level have a brick where a voxel is marked in them and, with
/// `neighbors`, the 26 round each of them (section 3.2.2, figure 25), as far as they are in the box.
/// @param voxels the leaves that surfaces pass through, in a box of any size.
BrickOctreeCount countBrickOctree(VoxelBits voxels, bool neighbors = true);

/// The voxels that the thesis's fragments fall into (section 3.2.1): each triangle is rasterised along the
/// axis that it faces most, a pixel a column of voxels. Where one of the pixel's samples is covered, a
/// fragment stands at the depth of the triangle's plane in the pixel's center. Nothing outside of the grid.
/// @param samples a pixel: 1, in its center, or 8, the standard pattern of D3D and Vulkan.
VoxelBits rasterizedVoxels(const Geometry& geometry, const gpu::VoxelGrid& grid, uint32_t samples);

/// All voxels that triangles pass through (visitVoxels()).
VoxelBits metVoxels(const Geometry& geometry, const gpu::VoxelGrid& grid);

}  // namespace voxray
