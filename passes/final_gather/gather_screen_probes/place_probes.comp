// A probe in each tile that shows a surface, in EXTRA probes more where its texels show surfaces on which there is no
// probe around. A thread for each tile, so that the same probes result in any order.
#include "passes/final_gather/gather_screen_probes/screen_probes.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/sampling.glsl"
layout(local_size_x = 64) in;

uniform sampler2D position;
uniform sampler2D normal;
uniform sampler2D geometricNormal;
#ifdef HAS_HISTORY
uniform sampler2D previous;
#endif
layout(scalar) buffer Slots { ScreenProbe data[]; } slots;  // slotsPerTile a tile.
#ifdef EXTRA
readonly buffer Counts { uint data[]; } counts;  // Probes of each tile without those that are added.
writeonly buffer ExtraCounts { uint data[]; } extraCounts;
#else
writeonly buffer Counts { uint data[]; } counts;
#endif
layout(push_constant, scalar) uniform Push {
    ProbeTiles tiles;
    vec3 camera;
    float widthPerDistance;  // Edge of a tile over its distance.
    uint slotsPerTile;
    uint seed;        // Of the run.
    uint frameIndex;
} push;

// Texel k of a tile in an order that begins anywhere: steps of a prime that no number of texels has for a factor.
ivec2 texelInOrder(uvec2 tile, uint first, uint k) {
    const uint edge = push.tiles.edge, i = (first + k * 1031u) % (edge * edge);
    return ivec2(tile * edge + uvec2(i % edge, i / edge));
}

bool hasSurface(ivec2 texel) {
    return all(lessThan(texel, ivec2(push.tiles.texels))) && texelFetch(position, texel, 0).w > 0.0;
}

ScreenProbe probeAt(ivec2 texel) {
    const vec4 p = texelFetch(position, texel, 0);
    ScreenProbe probe;
    probe.position = p.xyz;
    probe.offset = p.w;
    probe.normal = toOctahedral(normalize(texelFetch(normal, texel, 0).xyz));
    probe.faceNormal = toOctahedral(normalize(texelFetch(geometricNormal, texel, 0).xyz));
    probe.texel = uint(texel.x) | (uint(texel.y) << 16);
    probe.instance = 0u;
#ifdef HAS_HISTORY
    probe.instance = uint(texelFetch(previous, texel, 0).w);
#endif
    probe.width = push.widthPerDistance * distance(p.xyz, push.camera);
    return probe;
}

#ifdef EXTRA
// Whether a probe of the tile, or the first one of a tile around, is on the texel's surface and near.
bool isCovered(ivec2 texel, uvec2 tile, uint ownCount) {
    const vec3 point = texelFetch(position, texel, 0).xyz, n = normalize(texelFetch(geometricNormal, texel, 0).xyz);
    ivec2 first, last;
    tilesAround(push.tiles, ivec2(tile), first, last);
    for (int y = first.y; y <= last.y; ++y)
        for (int x = first.x; x <= last.x; ++x) {
            const uint other = uint(y) * push.tiles.tiles.x + uint(x);
            const bool isOwn = uvec2(x, y) == tile;
            const uint count = isOwn ? ownCount : counts.data[other];
            for (uint k = 0u; k < count; ++k) {
                const ScreenProbe probe = slots.data[other * push.slotsPerTile + k];
                if (screenWeight(vec2(unpackTexel(probe.texel) - texel), float(push.tiles.edge)) > 0.0 &&
                    surfaceWeight(point, n, probe, probe.width) > 0.0)
                    return true;
            }
        }
    return false;
}
#endif

void main() {
    const uint i = linearIndex();
    if (i >= push.tiles.tiles.x * push.tiles.tiles.y) return;
    const uvec2 tile = uvec2(i % push.tiles.tiles.x, i / push.tiles.tiles.x);
    const uint texels = push.tiles.edge * push.tiles.edge;
    // The same place in all tiles, so that probes are on a regular grid, and another one in each frame
    const uvec2 jitter = uvec2(sobol2(push.frameIndex, push.seed) * float(push.tiles.edge));
    const uint first = jitter.y * push.tiles.edge + jitter.x;

#ifdef EXTRA
    uint count = counts.data[i];
    for (uint k = 1u; k < texels && count > 0u && count < push.slotsPerTile; ++k) {
        const ivec2 texel = texelInOrder(tile, first, k);
        if (!hasSurface(texel) || isCovered(texel, tile, count)) continue;
        slots.data[i * push.slotsPerTile + count++] = probeAt(texel);
    }
    extraCounts.data[i] = count;
#else
    uint count = 0u;
    for (uint k = 0u; k < texels && count == 0u; ++k) {
        const ivec2 texel = texelInOrder(tile, first, k);
        if (hasSurface(texel)) slots.data[i * push.slotsPerTile + count++] = probeAt(texel);
    }
    counts.data[i] = count;
#endif
}
