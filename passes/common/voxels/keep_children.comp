// Clears the bits of voxels whose parents, the voxels twice as wide that hold them, have no bit. Grids without windows.
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxels/voxel_types.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Parents { uint words[]; } parents;
layout(scalar) buffer Bits { uint words[]; } bits;
layout(push_constant, scalar) uniform Push {
    uint wordsPerRow;
    uint rows;  // Along y.
    uint parentWordsPerRow;
    uint parentRows;
    uint words;
} push;

// Each of the lower 16 bits twice.
uint doubled(uint x) {
    x &= 0xffffu;
    x = (x | x << 8) & 0x00ff00ffu;
    x = (x | x << 4) & 0x0f0f0f0fu;
    x = (x | x << 2) & 0x33333333u;
    x = (x | x << 1) & 0x55555555u;
    return x | x << 1;
}

void main() {
    const uint word = linearIndex();
    if (word >= push.words || bits.words[word] == 0u) return;
    const uint inRow = word % push.wordsPerRow, row = word / push.wordsPerRow;
    const uint y = row % push.rows / 2u, z = row / push.rows / 2u;
    const uint parent = parents.words[(z * push.parentRows + y) * push.parentWordsPerRow + inRow / 2u];
    bits.words[word] &= doubled(parent >> (16u * (inRow & 1u)));
}
