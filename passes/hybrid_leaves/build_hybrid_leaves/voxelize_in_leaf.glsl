// Voxelizes triangles into the cells of leaves' grids: the triangle voxelizer within one voxel, where coordinates are
// small. One invocation per pair of a triangle and a leaf. Entry point of shaders that define processFragment(), for
// which a fragment's voxel is the cell in the grid `cellGrid`.
#ifndef VOXRAY_VOXELIZE_IN_LEAF_GLSL
#define VOXRAY_VOXELIZE_IN_LEAF_GLSL

#define CUSTOM_MAIN
#include "passes/common/triangle_voxelizer/exact.glsl"
#include "passes/hybrid_leaves/hybrid_leaves.glsl"
#include "shaders/octree/octree_cells.glsl"

// Triangle, voxel by packCell(), grid.
layout(scalar) readonly buffer PairsRef { LargeUints leafPairs; };

uint cellGrid;

void main() {
    const uint pair = linearIndex(), m = hybridLeaves.shape.gridResolution;
    if (pair >= voxelizer.tiles) return;
    const uint triangle = leafPairs.data[3u * pair];
    cellGrid = leafPairs.data[3u * pair + 2u];

    VoxelGrid cells = voxelizer.grid;
    cells.resolution = uvec3(m);
    cells.origin += vec3(unpackCell(leafPairs.data[3u * pair + 1u])) * voxelizer.grid.voxelSize;
    cells.voxelSize /= float(m);
    const uvec3 v = triangleVertices(triangle);
    const vec3 p0 = gridVertex(cells, v.x);
    const GridTriangle t =
        gridTriangle(cells, triangle, dominantAxis(cross(gridVertex(cells, v.y) - p0, gridVertex(cells, v.z) - p0)));
    if (t.area > 0.0) voxelizeTile(t, ivec2(0), int(m), ivec3(m));
}

#endif
