// By how much the light of each tile's surroundings is raised to give back what bound.comp took: 1 + excess / kept,
// over 5 x 5 tiles. Dark places get back little of what bright ones lost.
#include "passes/view/filter_irradiance/tiles.glsl"
layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar) readonly buffer Tiles { TileLight data[]; } tiles;
layout(scalar) writeonly buffer Raised { vec3 data[]; } raised;
layout(push_constant) uniform Push { uvec2 tileCount; } push;

// 1 4 6 4 1
float binomial(int x) { return x == 0 ? 6.0 : abs(x) == 1 ? 4.0 : 1.0; }

void main() {
    const ivec2 tile = ivec2(gl_GlobalInvocationID.xy), count = ivec2(push.tileCount);
    if (any(greaterThanEqual(tile, count))) return;
    vec3 kept = vec3(0.0), excess = vec3(0.0);
    for (int y = -2; y <= 2; ++y)
        for (int x = -2; x <= 2; ++x) {
            const ivec2 neighbor = tile + ivec2(x, y);
            if (any(lessThan(neighbor, ivec2(0))) || any(greaterThanEqual(neighbor, count))) continue;
            const TileLight light = tiles.data[neighbor.y * count.x + neighbor.x];
            kept += binomial(x) * binomial(y) * light.kept;
            excess += binomial(x) * binomial(y) * light.excess;
        }
    const vec3 fraction = mix(excess / max(kept, vec3(1e-30)), vec3(0.0), equal(kept, vec3(0.0)));
    raised.data[tile.y * count.x + tile.x] = 1.0 + fraction;
}
