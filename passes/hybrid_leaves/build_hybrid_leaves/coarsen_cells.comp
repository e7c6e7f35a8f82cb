// Cells of all levels but the finest: means over the finest cells in them, weighted by area.
#include "passes/hybrid_leaves/build_hybrid_leaves/cell_means.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(push_constant) uniform Push {
    uint grids;
    uint cellsPerGrid;  // In levels 1 and up.
} push;

void main() {
    if (linearIndex() >= push.grids * push.cellsPerGrid) return;
    const uint grid = linearIndex() / push.cellsPerGrid;
    uint indexInLevels = linearIndex() % push.cellsPerGrid, levelIndex = 1u;
    GridLevel level = gridLevel(grid, levelIndex);
    while (indexInLevels >= level.edge * level.edge * level.edge) {
        indexInLevels -= level.edge * level.edge * level.edge;
        level = gridLevel(grid, ++levelIndex);
    }
    const ivec3 cell = ivec3(indexInLevels % level.edge,
                             indexInLevels / level.edge % level.edge, indexInLevels / (level.edge * level.edge));
    const uint cellIndex = gridCellIndex(gridBit(level, cell));
    if (cellIndex == NO_CELL) return;

    // Sum the finest cells in a fixed order
    const GridLevel finestLevel = gridLevel(grid, 0u);
    const float scale = 1.0 / float(1u << levelIndex);
    const ivec3 firstCell = cell << levelIndex,
                lastCell = min(firstCell + int(1u << levelIndex), ivec3(finestLevel.edge)) - 1;
    CellSums sums = CellSums(0.0, vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), 0.0, 0.0, 0.0);
    for (int z = firstCell.z; z <= lastCell.z; ++z)
        for (int y = firstCell.y; y <= lastCell.y; ++y)
            for (int x = firstCell.x; x <= lastCell.x; ++x) {
                const uint finerIndex = gridCellIndex(gridBit(finestLevel, ivec3(x, y, z)));
                if (finerIndex == NO_CELL) continue;
                const vec3 center = (vec3(x, y, z) + 0.5) * scale - (vec3(cell) + 0.5);
                addSums(sums, loadCellSums(finerIndex), center, scale);
            }
    storeMeans(cellIndex, sums);
}
