// Bilinear interpolation between the centers of blocks of pixels, clamped to the outermost centers.
#ifndef VOXRAY_FILTER_BLOCK_INTERPOLATION_GLSL
#define VOXRAY_FILTER_BLOCK_INTERPOLATION_GLSL

struct BlockCorner {
    uint block;    // Row by row.
    float weight;  // 0 to 1.
};

// The four blocks around a pixel's center. blockSize: pixels along a block's edge.
BlockCorner[4] blockCorners(ivec2 pixel, float blockSize, uvec2 blocks) {
    const vec2 inBlocks = (vec2(pixel) + 0.5) / blockSize - 0.5, fraction = fract(inBlocks);
    const ivec2 first = ivec2(floor(inBlocks)), last = ivec2(blocks) - 1;
    BlockCorner corners[4];
    for (int i = 0; i < 4; ++i) {
        const ivec2 offset = ivec2(i & 1, i >> 1), block = clamp(first + offset, ivec2(0), last);
        const vec2 along = mix(1.0 - fraction, fraction, vec2(offset));
        corners[i] = BlockCorner(uint(block.y) * blocks.x + uint(block.x), along.x * along.y);
    }
    return corners;
}

#endif
