// Sums the squared residuals of pilots over tiles of blocks.
#include "passes/final_gather/residual_rays/residual_types.h"
#include "shaders/filter/ray_moments.h"
layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar) readonly buffer Moments { RayMoments data[]; } moments;  // Of each block.
layout(scalar) writeonly buffer Tiles { ResidualTile data[]; } tiles;
layout(push_constant, scalar) uniform Push {
    uvec2 blocks;
    uvec2 tileCount;
    uint tileBlocks;
} push;

void main() {
    const uvec2 tile = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(tile, push.tileCount))) return;
    ResidualTile sum = ResidualTile(0.0, 0.0, 0.0);
    const uvec2 end = min((tile + 1u) * push.tileBlocks, push.blocks);
    for (uint y = tile.y * push.tileBlocks; y < end.y; ++y)
        for (uint x = tile.x * push.tileBlocks; x < end.x; ++x) {
            const RayMoments m = moments.data[y * push.blocks.x + x];
            sum.squares += m.squared;
            sum.rays += m.rays;
        }
    tiles.data[tile.y * push.tileCount.x + tile.x] = sum;
}
