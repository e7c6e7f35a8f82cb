// By how much the light of each tile is raised to give back what the filter lost, or gained (keep_light.comp). Each tile's
// excess is shared by the 5 x 5 tiles around it, in proportion to the light that they kept: so nothing is lost, and dark
// places get back little of what bright ones lost. With SIGNED it is what bound.comp took, shared by area, and added.
#include "shaders/filter/tiles.glsl"
layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar) readonly buffer Tiles { TileLight data[]; } tiles;
layout(scalar) writeonly buffer Raised { vec3 data[]; } raised;
layout(push_constant) uniform Push { uvec2 tileCount; } push;

// 1 4 6 4 1
float binomial(int x) { return x == 0 ? 6.0 : abs(x) == 1 ? 4.0 : 1.0; }

// Weighted sum over the 5 x 5 tiles around one.
vec3 keptAround(ivec2 tile) {
    vec3 sum = vec3(0.0);
    const ivec2 count = ivec2(push.tileCount);
    for (int y = max(tile.y - 2, 0); y <= min(tile.y + 2, count.y - 1); ++y)
        for (int x = max(tile.x - 2, 0); x <= min(tile.x + 2, count.x - 1); ++x)
            sum += binomial(x - tile.x) * binomial(y - tile.y) * tiles.data[y * count.x + x].kept;
    return sum;
}

void main() {
    const ivec2 tile = ivec2(gl_GlobalInvocationID.xy), count = ivec2(push.tileCount);
    if (any(greaterThanEqual(tile, count))) return;
    vec3 share = vec3(0.0);
    for (int y = max(tile.y - 2, 0); y <= min(tile.y + 2, count.y - 1); ++y)
        for (int x = max(tile.x - 2, 0); x <= min(tile.x + 2, count.x - 1); ++x) {
            const TileLight light = tiles.data[y * count.x + x];
#ifdef SIGNED
            if (light.excess == vec3(0.0)) continue;
#else
            // Equal sums may differ by their rounding
            if (all(lessThanEqual(abs(light.excess), 4e-6 * light.kept))) continue;
#endif
            const vec3 kept = keptAround(ivec2(x, y));
            const vec3 part = binomial(x - tile.x) * binomial(y - tile.y) * light.excess / max(kept, vec3(1e-30));
            share += mix(part, vec3(0.0), lessThanEqual(kept, vec3(0.0)));
        }
#ifdef SIGNED
    raised.data[tile.y * count.x + tile.x] = share;
#else
    raised.data[tile.y * count.x + tile.x] = max(1.0 + share, vec3(0.0));
#endif
}
