// Two levels of maps, the coarse one of half as many texels a side: inverse depth, 1/m; 0 where nothing is known.
layout(scalar) buffer Fine { float data[]; } fine;
layout(scalar) buffer Coarse { float data[]; } coarse;
layout(push_constant) uniform Push {
    uint fineSide, coarseSide;
    uint maps;
} push;

uint fineTexel(uint map, ivec2 texel) { return (map * push.fineSide + uint(texel.y)) * push.fineSide + uint(texel.x); }
uint coarseTexel(uint map, ivec2 texel) { return (map * push.coarseSide + uint(texel.y)) * push.coarseSide + uint(texel.x); }
