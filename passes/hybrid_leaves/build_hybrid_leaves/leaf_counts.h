#pragma once

#include <cstdint>
#include <vector>

#include "scene/geometry.h"
#include "shaders/voxels/voxel_types.h"

namespace voxray {

/// How many triangles touch each voxel that any touches, counted on the host without a device, to predict
/// memory: an upper bound, by about a hundredth. What moves counts twice, as in countSurfaceVoxels(). Takes 4
/// bytes for each pair of a triangle and a voxel.
struct LeafCounts {
    std::vector<uint32_t> voxels;     ///< Ascending; 10 bits for each coordinate, x lowest.
    std::vector<uint32_t> triangles;  ///< As many, by voxel.

    /// Pairs of a triangle and a leaf, of the leaves that hold more than `capacity` triangles.
    uint64_t pairsInGrids(uint32_t capacity) const;
    /// Such leaves.
    uint32_t grids(uint32_t capacity) const;
    /// Items of the lists of all others.
    uint64_t items(uint32_t capacity) const;
};
LeafCounts countLeaves(const Geometry& geometry, const gpu::VoxelGrid& grid);

/// Cells that are not empty in the grids of the leaves that hold more than `capacity` triangles, m³ cells
/// each and their first `levels` levels: an upper bound likewise. Takes a bit for each cell.
uint64_t countGridCells(const Geometry& geometry, const gpu::VoxelGrid& grid, const LeafCounts& counts,
                        uint32_t capacity, uint32_t m, uint32_t levels);

}  // namespace voxray
