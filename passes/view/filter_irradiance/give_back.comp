// By how much the light of each tile is raised to give back what bound.comp took: 1 + excess / kept, over the 5 x 5
// tiles around. Dark places get back little of what bright ones lost. With SIGNED what is added to it: each tile's
// excess, shared by the area of the 5 x 5 tiles around it.
#include "shaders/filter/tiles.glsl"
layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar) readonly buffer Tiles { TileLight data[]; } tiles;
layout(scalar) writeonly buffer Raised { vec3 data[]; } raised;
layout(push_constant) uniform Push { uvec2 tileCount; } push;

// 1 4 6 4 1
float binomial(int x) { return x == 0 ? 6.0 : abs(x) == 1 ? 4.0 : 1.0; }

// Weighted sums over the 5 x 5 tiles around one.
TileLight sumAround(ivec2 tile) {
    TileLight sum = TileLight(vec3(0.0), vec3(0.0));
    const ivec2 count = ivec2(push.tileCount);
    for (int y = max(tile.y - 2, 0); y <= min(tile.y + 2, count.y - 1); ++y)
        for (int x = max(tile.x - 2, 0); x <= min(tile.x + 2, count.x - 1); ++x) {
            const float weight = binomial(x - tile.x) * binomial(y - tile.y);
            const TileLight light = tiles.data[y * count.x + x];
            sum.kept += weight * light.kept;
            sum.excess += weight * light.excess;
        }
    return sum;
}

void main() {
    const ivec2 tile = ivec2(gl_GlobalInvocationID.xy), count = ivec2(push.tileCount);
    if (any(greaterThanEqual(tile, count))) return;
#ifdef SIGNED
    vec3 added = vec3(0.0);
    for (int y = max(tile.y - 2, 0); y <= min(tile.y + 2, count.y - 1); ++y)
        for (int x = max(tile.x - 2, 0); x <= min(tile.x + 2, count.x - 1); ++x) {
            const vec3 excess = tiles.data[y * count.x + x].excess;
            if (excess != vec3(0.0))
                added += binomial(x - tile.x) * binomial(y - tile.y) * excess / sumAround(ivec2(x, y)).kept;
        }
    raised.data[tile.y * count.x + tile.x] = added;
#else
    const TileLight sum = sumAround(tile);
    const vec3 fraction = mix(sum.excess / max(sum.kept, vec3(1e-30)), vec3(0.0), equal(sum.kept, vec3(0.0)));
    raised.data[tile.y * count.x + tile.x] = 1.0 + fraction;
#endif
}
