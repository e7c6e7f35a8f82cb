// Two adjacent levels of the maps' pyramid: inverse depth, 1/m; 0 where unknown. The coarse one has half the
// resolution.
layout(scalar) buffer Fine { float data[]; } fine;
layout(scalar) buffer Coarse { float data[]; } coarse;
layout(push_constant) uniform Push {
    uint fineResolution, coarseResolution;
    uint mapCount;
} push;

uint texelIndex(uint resolution, uint map, ivec2 texel) {
    return (map * resolution + uint(texel.y)) * resolution + uint(texel.x);
}
uint fineTexel(uint map, ivec2 texel) { return texelIndex(push.fineResolution, map, texel); }
uint coarseTexel(uint map, ivec2 texel) { return texelIndex(push.coarseResolution, map, texel); }
