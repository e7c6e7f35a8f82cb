// The cells of a leaf's grid that a triangle overlaps: the walk over voxels once more, within one voxel, where coordinates are small. A
// thread takes a pair of a triangle and a leaf: where triangles are many they are small. Entry point of compute shaders that define
// visitFragment(), to whom a fragment's voxel is the cell in the grid; the grid's number is cellGrid.
#ifndef VOXRAY_GRID_CELLS_GLSL
#define VOXRAY_GRID_CELLS_GLSL

#define OWN_MAIN
#include "passes/common/triangle_walk/exact.glsl"
#include "passes/hybrid_leaves/hybrid_leaves.glsl"
#include "shaders/octree/octree_cells.glsl"

// Triangle, voxel by packCell(), and grid of each.
layout(scalar) readonly buffer PairsAt { LargeUints leafPairs; };

uint cellGrid;

void main() {
    const uint pair = linearIndex(), m = hybridLeaves.shape.gridResolution;
    if (pair >= walk.tiles) return;
    const uint triangle = leafPairs.data[3u * pair];
    cellGrid = leafPairs.data[3u * pair + 2u];

    VoxelGrid cells = walk.grid;
    cells.resolution = uvec3(m);
    cells.origin += vec3(unpackCell(leafPairs.data[3u * pair + 1u])) * walk.grid.voxelSize;
    cells.voxelSize /= float(m);
    const uvec3 v = triangleVertices(triangle);
    const vec3 p0 = gridVertex(cells, v.x);
    const GridTriangle t =
        gridTriangle(cells, triangle, dominantAxis(cross(gridVertex(cells, v.y) - p0, gridVertex(cells, v.z) - p0)));
    if (t.area > 0.0) visitTile(t, ivec2(0), int(m), ivec3(m));
}

#endif
