#pragma once

#include <cstdint>
#include <vector>

#include "passes/common/voxels/voxel_bits.h"
#include "scene/geometry.h"
#include "shaders/voxels/voxel_types.h"

namespace voxray {

/// The octree of Arnebäck 2017, chapter 3, as published: nodes of 11 words in blocks of eight siblings, and
/// for each node that is subdivided or a leaf a brick of 3x3x3 values of 8 bits a channel at its corners, the
/// centers of its edges and faces, and its own.
constexpr uint64_t kBrickNodeBytes = 11 * sizeof(uint32_t), kBrickBytes = 27 * sizeof(uint32_t);

/// What such an octree holds: all that its memory depends on.
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

/// Which nodes of each level have a brick, leaves first: those in which a voxel is marked and, with
/// `neighbors`, the 26 round each of them (section 3.2.2, figure 25), as far as they are in the box.
/// @param voxels the leaves that surfaces pass through, in a box of any size.
std::vector<VoxelBits> brickLevels(VoxelBits voxels, bool neighbors);

/// Counts nodes and bricks over the same voxels.
BrickOctreeCount countBrickOctree(VoxelBits voxels, bool neighbors = true);

/// The voxels that the thesis's fragments fall into (section 3.2.1): each triangle is rasterised along the
/// axis that it faces most, a pixel a column of voxels. Where one of the pixel's samples is covered, a
/// fragment stands at the depth of the triangle's plane in the pixel's center. Nothing outside of the grid.
/// @param samples a pixel: 1, in its center, or 8, the standard pattern of D3D and Vulkan.
VoxelBits rasterizedVoxels(const Geometry& geometry, const gpu::VoxelGrid& grid, uint32_t samples);

/// The number of these fragments, of all triangles.
uint64_t countFragments(const Geometry& geometry, const gpu::VoxelGrid& grid, uint32_t samples);

/// All voxels that triangles pass through (visitVoxels()).
VoxelBits metVoxels(const Geometry& geometry, const gpu::VoxelGrid& grid);

}  // namespace voxray
