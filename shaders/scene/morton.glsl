// Morton order of points of a grid: squares of any power of two along the edge are runs of it.
#ifndef VOXRAY_MORTON_GLSL
#define VOXRAY_MORTON_GLSL

// Moves the low 16 bits to the even bits, and back.
uint expandBits(uint x) {
    x &= 0xffffu;
    x = (x | (x << 8)) & 0x00ff00ffu;
    x = (x | (x << 4)) & 0x0f0f0f0fu;
    x = (x | (x << 2)) & 0x33333333u;
    return (x | (x << 1)) & 0x55555555u;
}

uint compactBits(uint x) {
    x &= 0x55555555u;
    x = (x | (x >> 1)) & 0x33333333u;
    x = (x | (x >> 2)) & 0x0f0f0f0fu;
    x = (x | (x >> 4)) & 0x00ff00ffu;
    return (x | (x >> 8)) & 0xffffu;
}

uint morton(uvec2 p) { return expandBits(p.x) | (expandBits(p.y) << 1); }
uvec2 mortonInverse(uint code) { return uvec2(compactBits(code), compactBits(code >> 1)); }

#endif
