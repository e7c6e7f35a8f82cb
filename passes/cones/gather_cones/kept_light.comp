// By how much the diffuse light of each tile is raised so that the 5 x 5 tiles around reflect as much as without the mean
// over texels.
#include "shaders/filter/tiles.glsl"
layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar) readonly buffer Tiles { TileLight data[]; } tiles;
layout(scalar) writeonly buffer Raised { vec3 data[]; } raised;
layout(push_constant) uniform Push { uvec2 tileCount; } push;

// 1 4 6 4 1
float binomial(int x) { return x == 0 ? 6.0 : abs(x) == 1 ? 4.0 : 1.0; }

void main() {
    const ivec2 tile = ivec2(gl_GlobalInvocationID.xy), count = ivec2(push.tileCount);
    if (any(greaterThanEqual(tile, count))) return;
    vec3 kept = vec3(0.0), own = vec3(0.0);
    for (int y = max(tile.y - 2, 0); y <= min(tile.y + 2, count.y - 1); ++y)
        for (int x = max(tile.x - 2, 0); x <= min(tile.x + 2, count.x - 1); ++x) {
            const float weight = binomial(x - tile.x) * binomial(y - tile.y);
            const TileLight light = tiles.data[y * count.x + x];
            kept += weight * light.kept;
            own += weight * (light.kept + light.excess);
        }

    // Sums of residuals may have any sign: where either is not positive it tells nothing
    const bvec3 isKnown = bvec3(ivec3(greaterThan(kept, vec3(0.0))) & ivec3(greaterThan(own, vec3(0.0))));
    raised.data[tile.y * count.x + tile.x] = mix(vec3(1.0), own / mix(vec3(1.0), kept, isKnown), isKnown);
}
