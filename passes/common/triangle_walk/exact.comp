#version 460
#extension GL_GOOGLE_include_directive : require
// Every voxel that a triangle overlaps, by separating axes. A thread takes a tile of 8x8 columns of one triangle.
#include "shaders/compute/linear_index.glsl"
#include "passes/common/triangle_walk/clipped_area.glsl"
#include "passes/common/triangle_walk/visit.glsl"
layout(local_size_x = 64) in;

// Triangle; its first column (10 bits each) and, from bit 20, the axis that columns run along.
layout(set = 0, binding = 17, scalar) readonly buffer Tiles { uvec2 data[]; } tiles;
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint tileCount;
    float scale;  // Of what visit() adds up.
} push;

#ifndef MARK
float measureFragment(GridTriangle t, ivec3 voxel, uint own, out vec2 center) { return clippedArea(t, voxel, center); }
#endif

void main() {
    const uint i = linearIndex();
    if (i >= push.tileCount) return;
    const uvec2 tile = tiles.data[i];
    const GridTriangle t = gridTriangle(push.grid, tile.x, tile.y >> 20);
    if (t.area == 0.0) return;
    const ivec3 resolution = ivec3(permutedVoxels(push.grid.resolution, t.axis));
    const ivec2 first = ivec2(tile.y & 1023u, (tile.y >> 10) & 1023u);
    const ivec4 range = columnRange(t, kMargin, resolution.xy);
    const ivec2 from = max(range.xy, first), size = min(range.zw, first + 7) - from + 1;
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
        visit(push.grid, t, voxel, push.scale);
    }
}
