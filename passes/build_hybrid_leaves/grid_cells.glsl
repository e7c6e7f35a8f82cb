// The cells of a leaf's grid that a triangle overlaps: the walk over voxels once more, within one voxel, in which coordinates are
// small. The including shader defines visitCell() and calls visitCells() for each pair of a triangle and a grid leaf.
#ifndef VOXRAY_GRID_CELLS_GLSL
#define VOXRAY_GRID_CELLS_GLSL

#include "passes/common/triangle_walk/exact.glsl"
#include "shaders/hybrid_leaves/hybrid_leaves.glsl"
#include "shaders/voxels/voxels.glsl"

// @param cell the triangle's fragment in it; its place in the grid is cell.voxel. @param grid the leaf's grid, by number.
void visitCell(TriangleFragment cell, uint grid);

void visitCells(TriangleFragment f) {
    const uint leaf = voxelNumber(walk.grid, f.voxel);
    if (leaf == NO_VOXEL) return;
    const uint word = hybridLeaves.words.data[leaf];
    if (!isGridLeaf(word)) return;

    VoxelGrid cells = walk.grid;
    cells.resolution = uvec3(hybridLeaves.shape.gridResolution);
    cells.origin += vec3(f.voxel) * walk.grid.voxelSize;
    cells.voxelSize /= float(cells.resolution.x);
    const GridTriangle t = gridTriangle(cells, f.triangle, f.permutedTriangle.axis);
    if (t.area == 0.0) return;
    const ivec2 resolution = ivec2(cells.resolution);
    const ivec4 range = columnRange(t, kMargin, resolution);
    for (int y = range.y; y <= range.w; ++y)
        for (int x = range.x; x <= range.z; ++x) {
            if (!overlapsColumn(t, ivec2(x, y), kMargin)) continue;
            const ivec2 depths = depthRange(t, ivec2(x, y), kMargin, resolution.x);
            for (int z = depths.x; z <= depths.y; ++z)
                if (overlapsVoxel(t, ivec3(x, y, z), kMargin))
                    visitCell(triangleFragment(t, ivec3(x, y, z)), word & ~LEAF_IS_GRID);
        }
}

#endif
