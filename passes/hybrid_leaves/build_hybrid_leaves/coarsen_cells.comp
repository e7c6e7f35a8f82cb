// Cells of all levels but the finest: averages of the finest cells in them, weighted by area. A thread takes a cell of one grid.
#include "passes/hybrid_leaves/build_hybrid_leaves/cell_means.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(push_constant) uniform Push {
    uint grids;
    uint cellsPerGrid;  // Of these levels.
} push;

void main() {
    if (linearIndex() >= push.grids * push.cellsPerGrid) return;
    const uint grid = linearIndex() / push.cellsPerGrid;
    uint within = linearIndex() % push.cellsPerGrid, doublings = 1u;
    GridLevel level = gridLevel(grid, doublings);
    while (within >= level.edge * level.edge * level.edge) {
        within -= level.edge * level.edge * level.edge;
        level = gridLevel(grid, ++doublings);
    }
    const ivec3 cell = ivec3(within % level.edge, within / level.edge % level.edge, within / (level.edge * level.edge));
    const uint number = gridCellNumber(gridBit(level, cell));
    if (number == NO_CELL) return;

    // All finest cells in it, in the same order each time
    const GridLevel finest = gridLevel(grid, 0u);
    const float scale = 1.0 / float(1u << doublings);
    const ivec3 first = cell << doublings, last = min(first + int(1u << doublings), ivec3(finest.edge)) - 1;
    CellSums sums = CellSums(0.0, vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), 0.0, 0.0, 0.0);
    for (int z = first.z; z <= last.z; ++z)
        for (int y = first.y; y <= last.y; ++y)
            for (int x = first.x; x <= last.x; ++x) {
                const uint finer = gridCellNumber(gridBit(finest, ivec3(x, y, z)));
                if (finer == NO_CELL) continue;
                const vec3 center = (vec3(x, y, z) + 0.5) * scale - (vec3(cell) + 0.5);
                addSums(sums, cellSumsOf(finer), center, scale);
            }
    storeMeans(number, sums);
}
