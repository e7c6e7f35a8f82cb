#pragma once

#include <vector>

#include "graph/pass.h"
#include "passes/common/voxels/voxels.h"
#include "passes/hybrid_leaves/hybrid_types.h"

namespace voxray {

/// Levels of a full pyramid over a grid of m³: the coarsest has 2 cells along an edge.
inline uint32_t allGridLevels(uint32_t m) {
    uint32_t levels = 1;
    while (GRID_EDGE(m, levels) >= 2) ++levels;
    return levels;
}

/// Cells of a grid of m³ in levels [first, end), empty ones included.
inline uint32_t gridCells(uint32_t m, uint32_t first, uint32_t end) {
    uint32_t cells = 0;
    for (uint32_t level = first; level < end; ++level)
        cells += GRID_EDGE(m, level) * GRID_EDGE(m, level) * GRID_EDGE(m, level);
    return cells;
}

/// Leaves of the octree over surface voxels: lists of triangles or, where these are many, grids of finer
/// voxels, their cells (Seok 2021, section 3.1). Leaves have the indices of voxels(). Users build the octree
/// themselves (VoxelMarch). GLSL access: passes/hybrid_leaves/hybrid_leaves.glsl.
struct HybridLeaves : Resource {
    std::string indexedBy() const override { return "voxels"; }

    gpu::HybridShape shape{};
    uint32_t gridCount = 0;
    uint32_t emptyCount = 0;      ///< Leaves without triangles.
    uint32_t primitiveCount = 0;  ///< Triangles in all lists.
    uint32_t cellCount = 0;       ///< Occupied cells of all grids and levels.
    Buffer header;                ///< Addresses of the arrays, and `shape`.
    Buffer words;                 ///< One word per leaf.
    Buffer primitives;            ///< List items (LIST_ITEMS()); at least one word.
    Buffer corners;               ///< Three positions for each triangle of the scene.
    Buffer gridBits, gridRanks;   ///< Occupancy of cells, and its prefix sums by word.
    Buffer cells;                 ///< shape.cellWords each. Empty, as the bits are, without grids.

    /// Surface voxels, and others that list triangles: of masked triangles that are too transparent, and of raster
    /// fragments; without materials. Empty where there are none of either. Its version is that of the surface voxels.
    SurfaceVoxels listing;

    /// The voxels that leaves are indexed by. @param surface the surface voxels that they are built over.
    const SurfaceVoxels& voxels(const SurfaceVoxels& surface) const { return listing.occupancy ? listing : surface; }
    std::vector<Binding> bindings() const { return {ifUsed({"hybridLeaves", header})}; }
    uint64_t structureBytes() const {
        return header.bytes() + words.bytes() + listing.occupancy.bytes() + listing.rank.bytes();
    }
    uint64_t listBytes() const { return primitives.bytes(); }
    uint64_t gridBytes() const { return gridBits.bytes() + gridRanks.bytes() + cells.bytes(); }
    /// Frees all but the header and the corners.
    void release() {
        words = {}, primitives = {}, gridBits = {}, gridRanks = {}, cells = {}, listing = {};
        gridCount = emptyCount = primitiveCount = cellCount = 0;
    }
};

}  // namespace voxray
