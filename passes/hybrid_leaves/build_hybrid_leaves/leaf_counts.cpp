#include "passes/hybrid_leaves/build_hybrid_leaves/leaf_counts.h"

#include <algorithm>

#include "passes/common/voxels/triangle_voxels.h"
#include "passes/hybrid_leaves/hybrid_leaves.h"

namespace voxray {
namespace {

uint32_t packed(glm::ivec3 v) {
    return uint32_t(v.x | v.y << 10 | v.z << 20);
}

/// 1 for triangles that stay, 2 for those that move.
std::vector<uint32_t> weights(const Geometry& geometry) {
    std::vector<uint32_t> result(geometry.triangles.size(), 1);
    for (const InstanceRange& run : movingRuns(geometry))
        std::fill_n(result.begin() + run.firstTriangle, run.triangleCount, 2u);
    return result;
}

/// Marks the cells of a level that hold marked ones of the level before.
/// @param first of the grid's cells.
void markCoarser(std::vector<bool>& marked, size_t first, uint32_t m, uint32_t level) {
    const uint32_t edge = GRID_EDGE(m, level - 1), coarseEdge = GRID_EDGE(m, level);
    size_t from = first + gridCells(m, 0, level - 1);
    const size_t to = first + gridCells(m, 0, level);
    for (uint32_t z = 0; z < edge; ++z)
        for (uint32_t y = 0; y < edge; ++y)
            for (uint32_t x = 0; x < edge; ++x, ++from)
                if (marked[from])
                    marked[to + x / 2 + coarseEdge * (y / 2 + size_t(coarseEdge) * (z / 2))] = true;
}

}  // namespace

uint64_t LeafCounts::items(uint32_t capacity) const {
    uint64_t sum = 0;
    for (const uint32_t count : triangles) sum += count <= capacity ? LIST_ITEMS(uint64_t(count)) : 0;
    return sum;
}

uint64_t LeafCounts::pairsInGrids(uint32_t capacity) const {
    uint64_t sum = 0;
    for (const uint32_t count : triangles) sum += count > capacity ? count : 0;
    return sum;
}

uint32_t LeafCounts::grids(uint32_t capacity) const {
    return uint32_t(std::ranges::count_if(triangles, [&](uint32_t count) { return count > capacity; }));
}

LeafCounts countLeaves(const Geometry& geometry, const gpu::VoxelGrid& grid) {
    const std::vector<uint32_t> weight = weights(geometry);
    std::vector<uint32_t> pairs;  // The voxel of each.
    for (uint32_t t = 0; t < geometry.triangles.size(); ++t)
        visitVoxels(grid.resolution, cornersInVoxels(geometry, grid, t),
                    [&](glm::ivec3 v) { pairs.insert(pairs.end(), weight[t], packed(v)); });
    std::ranges::sort(pairs);

    LeafCounts counts;
    for (const uint32_t voxel : pairs) {
        if (counts.voxels.empty() || counts.voxels.back() != voxel) {
            counts.voxels.push_back(voxel);
            counts.triangles.push_back(0);
        }
        ++counts.triangles.back();
    }
    return counts;
}

uint64_t countGridCells(const Geometry& geometry, const gpu::VoxelGrid& grid, const LeafCounts& counts,
                        uint32_t capacity, uint32_t m, uint32_t levels) {
    std::vector<uint32_t> grids;
    for (size_t i = 0; i < counts.voxels.size(); ++i)
        if (counts.triangles[i] > capacity) grids.push_back(counts.voxels[i]);
    const size_t cellsOfGrid = gridCells(m, 0, levels);
    const auto countOf = [&](bool moving) {
        const std::vector<uint32_t> weight = weights(geometry);
        std::vector<bool> marked(grids.size() * cellsOfGrid);
        for (uint32_t t = 0; t < geometry.triangles.size(); ++t) {
            if ((weight[t] == 2) != moving) continue;
            const std::array<glm::dvec3, 3> corners = cornersInVoxels(geometry, grid, t);
            visitVoxels(grid.resolution, corners, [&](glm::ivec3 voxel) {
                const auto found = std::ranges::lower_bound(grids, packed(voxel));
                if (found == grids.end() || *found != packed(voxel)) return;
                const size_t first = size_t(found - grids.begin()) * cellsOfGrid;
                std::array<glm::dvec3, 3> inCells;
                for (size_t k = 0; k < 3; ++k) inCells[k] = (corners[k] - glm::dvec3(voxel)) * double(m);
                visitVoxels(glm::uvec3(m), inCells, [&](glm::ivec3 finest) {
                    const glm::uvec3 cell(finest);
                    marked[first + cell.x + size_t(m) * (cell.y + size_t(m) * cell.z)] = true;
                });
            });
        }
        for (size_t grid = 0; grid < grids.size(); ++grid)
            for (uint32_t level = 1; level < levels; ++level)
                markCoarser(marked, grid * cellsOfGrid, m, level);
        return uint64_t(std::ranges::count(marked, true));
    };
    if (grids.empty()) return 0;
    return countOf(false) + (movingRuns(geometry).empty() ? 0 : 2 * countOf(true));
}

}  // namespace voxray
