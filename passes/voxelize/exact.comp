#version 460
#extension GL_GOOGLE_include_directive : require
// Every voxel that a triangle overlaps, by separating axes. A thread takes a tile of 8x8 columns of one triangle.
#include "shaders/linear_index.glsl"
#include "passes/voxelize/clipped_area.glsl"
#include "passes/voxelize/visit.glsl"
layout(local_size_x = 64) in;

// Triangle; its first column (10 bits each) and, from bit 20, the axis that columns run along.
layout(set = 0, binding = 17, scalar) readonly buffer Tiles { uvec2 data[]; } tiles;
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint tileCount;
    float emissionScale;
} push;

#ifndef MARK
float measurePiece(GridTriangle t, ivec3 voxel, uint own, out vec2 middle) { return clippedArea(t, voxel, middle); }
#endif

void main() {
    const uint i = linearIndex();
    if (i >= push.tileCount) return;
    const uvec2 tile = tiles.data[i];
    const GridTriangle t = gridTriangle(push.grid, tile.x, tile.y >> 20);
    if (t.area == 0.0) return;
    const ivec3 resolution = ivec3(turnedVoxels(push.grid.resolution, t.axis));
    const ivec2 first = ivec2(tile.y & 1023u, (tile.y >> 10) & 1023u);
    const ivec4 range = columnRange(t, kMargin, resolution.xy);
    const ivec2 from = max(range.xy, first), to = min(range.zw, first + 7);
    for (int y = from.y; y <= to.y; ++y)
        for (int x = from.x; x <= to.x; ++x) {
            if (!overlapsColumn(t, ivec2(x, y), kMargin)) continue;
            const ivec2 depths = depthRange(t, ivec2(x, y), kMargin, resolution.z);
            for (int z = depths.x; z <= depths.y; ++z)
                if (overlapsVoxel(t, ivec3(x, y, z), kMargin)) visit(push.grid, t, ivec3(x, y, z), push.emissionScale);
        }
}
