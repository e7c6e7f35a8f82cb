// Two adjacent levels of the maps' pyramid: inverse depth, 1/m; 0 where unknown. The coarse one has half the resolution.
layout(scalar) buffer Fine { float data[]; } fine;
layout(scalar) buffer Coarse { float data[]; } coarse;
layout(push_constant) uniform Push {
    uint fineResolution, coarseResolution;
    uint mapCount;
} push;

uint fineTexel(uint map, ivec2 texel) { return (map * push.fineResolution + uint(texel.y)) * push.fineResolution + uint(texel.x); }
uint coarseTexel(uint map, ivec2 texel) { return (map * push.coarseResolution + uint(texel.y)) * push.coarseResolution + uint(texel.x); }
