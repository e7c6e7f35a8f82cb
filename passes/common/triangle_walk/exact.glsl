// Every voxel of a tile of 8x8 columns that a triangle overlaps, by separating axes. Entry point of compute shaders that define
// visitFragment().
#include "passes/common/triangle_walk/clipped_area.glsl"
#include "passes/common/triangle_walk/clipped_fragment.glsl"
#include "passes/common/triangle_walk/walk_push.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

// Triangle; its first column (10 bits each) and, from bit 20, the axis that columns run along.
layout(scalar) readonly buffer TriangleTiles { uvec2 data[]; } triangleTiles;

float measureFragment(GridTriangle t, ivec3 permutedVoxel, uint subSamples, out vec2 center) {
    return clippedArea(t, permutedVoxel, center);
}

// Visits the voxels that a triangle overlaps in the columns from `first` on, `side` along each axis, of a grid of `resolution` voxels,
// permuted as the triangle is.
void visitTile(GridTriangle t, ivec2 first, int side, ivec3 resolution) {
    const ivec4 range = columnRange(t, kMargin, resolution.xy);
    const ivec2 from = max(range.xy, first), size = min(range.zw, first + side - 1) - from + 1;
    if (any(lessThan(size, ivec2(1)))) return;

    // Each turn finds the tile's next voxel, then visits it: threads whose voxels lie differently still visit together.
    int column = -1, lastDepth = 0;
    ivec3 voxel = ivec3(0);
    for (;;) {
        bool found = false;
        while (!found) {
            if (column >= 0 && voxel.z < lastDepth) {
                ++voxel.z;
            } else {
                if (++column == size.x * size.y) break;
                voxel.xy = from + ivec2(column % size.x, column / size.x);
                const ivec2 depths = depthRange(t, voxel.xy, kMargin, resolution.z);
                voxel.z = depths.x;
                lastDepth = overlapsColumn(t, voxel.xy, kMargin) ? depths.y : depths.x - 1;
            }
            found = voxel.z <= lastDepth && overlapsVoxel(t, voxel, kMargin);
        }
        if (!found) return;
        visitFragment(triangleFragment(t, voxel));
    }
}

#ifndef OWN_MAIN
void main() {
    const uint i = linearIndex();
    if (i >= walk.tiles) return;
    const uvec2 tile = triangleTiles.data[i];
    const GridTriangle t = gridTriangle(walk.grid, tile.x, tile.y >> 20);
    if (t.area == 0.0) return;
    visitTile(t, ivec2(tile.y & 1023u, (tile.y >> 10) & 1023u), 8, ivec3(permutedVoxels(walk.grid.resolution, t.axis)));
}
#endif
