// All voxels that a triangle overlaps, by separating axes, in tiles of 8x8 columns per thread. Entry point of compute
// shaders that define processFragment().
#include "passes/common/triangle_voxelizer/clipped_area.glsl"
#include "passes/common/triangle_voxelizer/clipped_fragment.glsl"
#include "passes/common/triangle_voxelizer/voxelizer_push.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

// Triangle; its first column (10 bits each) and, from bit 20, the axis that columns run along.
layout(scalar) readonly buffer TriangleTiles { uvec2 data[]; } triangleTiles;

float measureFragment(GridTriangle t, ivec3 permutedVoxel, uint subSamples, out vec2 center) {
    return clippedArea(t, permutedVoxel, center);
}

// Processes the voxels that a triangle overlaps in side x side columns from `first` on. `resolution`: of the grid,
// permuted as the triangle is.
void voxelizeTile(GridTriangle t, ivec2 first, int side, ivec3 resolution) {
    const ivec4 range = columnRange(t, kMargin, resolution.xy);
    const ivec2 from = max(range.xy, first), size = min(range.zw, first + side - 1) - from + 1;
    if (any(lessThan(size, ivec2(1)))) return;

    // Each iteration finds the tile's next voxel, then processes it: threads with different columns still process
    // together.
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
        processFragment(triangleFragment(t, voxel));
    }
}

#ifndef CUSTOM_MAIN
void main() {
    const uint i = linearIndex();
    if (i >= voxelizer.tiles) return;
    const uvec2 tile = triangleTiles.data[i];
    const GridTriangle t = gridTriangle(voxelizer.grid, tile.x, tile.y >> 20);
    if (t.area == 0.0) return;
    voxelizeTile(t, ivec2(tile.y & 1023u, (tile.y >> 10) & 1023u), 8,
                 ivec3(permutedVoxels(voxelizer.grid.resolution, t.axis)));
}
#endif
