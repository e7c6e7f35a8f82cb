#pragma once

#include <vector>

#include "graph/pass.h"
#include "passes/common/voxels/voxels.h"
#include "passes/hybrid_leaves/hybrid_types.h"

namespace voxray {

/// Levels of cells that a grid of m³ has where it has all: the coarsest has 2 along an edge.
inline uint32_t allGridLevels(uint32_t m) {
    uint32_t levels = 1;
    while (GRID_EDGE(m, levels) >= 2) ++levels;
    return levels;
}

/// Cells of a grid of m³, full ones and empty ones, from level `first` up to, but without, `end`.
inline uint32_t gridCells(uint32_t m, uint32_t first, uint32_t end) {
    uint32_t cells = 0;
    for (uint32_t level = first; level < end; ++level)
        cells += GRID_EDGE(m, level) * GRID_EDGE(m, level) * GRID_EDGE(m, level);
    return cells;
}

/// What the leaves of the octree over surface voxels hold: lists of triangles, or grids of finer voxels,
/// cells, where triangles are many (Seok 2021, section 3.1). Leaves are numbered as voxels() are; the
/// octree's structure is its users' (VoxelMarch). GLSL access: passes/hybrid_leaves/hybrid_leaves.glsl.
struct HybridLeaves : Resource {
    std::string basisPort() const override { return "voxels"; }

    gpu::HybridShape shape{};
    uint32_t gridCount = 0;
    uint32_t emptyCount = 0;      ///< Leaves that hold nothing.
    uint32_t primitiveCount = 0;  ///< Triangles of all lists.
    uint32_t cellCount = 0;       ///< Of all levels of all grids, those that are not empty.
    Buffer header;                ///< Addresses of the arrays, and `shape`.
    Buffer words;                 ///< A word a leaf.
    Buffer primitives;            ///< Items, list by list (LIST_ITEMS()); at least one word.
    Buffer corners;               ///< Three positions for each of the scene's triangles.
    Buffer gridBits, gridRanks;   ///< A bit for each cell, and the cells before each word.
    Buffer cells;                 ///< shape.cellWords each. Like the bits, none where no leaf has a grid.

    /// Surface voxels and those in which alpha masks leave too little to make them one; without materials.
    /// Not there in scenes without masks. Its version is that of the surface voxels.
    SurfaceVoxels masked;

    /// The voxels that the leaves are numbered by, out of the surface voxels that they are built over.
    const SurfaceVoxels& voxels(const SurfaceVoxels& surface) const {
        return masked.occupancy ? masked : surface;
    }
    std::vector<Binding> bindings() const { return {ifUsed({"hybridLeaves", header})}; }
    uint64_t structureBytes() const {
        return header.bytes() + words.bytes() + masked.occupancy.bytes() + masked.rank.bytes();
    }
    uint64_t listBytes() const { return primitives.bytes(); }
    uint64_t gridBytes() const { return gridBits.bytes() + gridRanks.bytes() + cells.bytes(); }
    /// Frees all but the header and the corners.
    void release() {
        words = {}, primitives = {}, gridBits = {}, gridRanks = {}, cells = {}, masked = {};
        gridCount = emptyCount = primitiveCount = cellCount = 0;
    }
};

}  // namespace voxray
