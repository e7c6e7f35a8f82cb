// Sums over tiles of the sums over their columns (keep_light.comp), for give_back.comp.
#include "shaders/filter/tiles.glsl"
layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar) readonly buffer Columns { TileLight data[]; } columns;
layout(scalar) writeonly buffer Tiles { TileLight data[]; } tiles;
layout(push_constant) uniform Push { uvec2 pixels; } push;

void main() {
    const uvec2 tile = gl_GlobalInvocationID.xy, count = tilesOf(push.pixels);
    if (any(greaterThanEqual(tile, count))) return;
    TileLight sum = TileLight(vec3(0.0), vec3(0.0));
    for (uint x = uint(TILE) * tile.x; x < min(uint(TILE) * (tile.x + 1u), push.pixels.x); ++x) {
        const TileLight column = columns.data[tile.y * push.pixels.x + x];
        sum.kept += column.kept;
        sum.excess += column.excess;
    }
    tiles.data[tile.y * count.x + tile.x] = sum;
}
