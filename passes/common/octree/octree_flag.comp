// Flags the cells of a level that hold a flagged cell of the next finer level, and counts them: a bit per cell, in rows
// along x that are padded to whole words, as in SurfaceVoxels.
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

readonly buffer Finer { uint words[]; } finer;
writeonly buffer Coarser { uint words[]; } coarser;
buffer Counts { uint cells[]; } counts;
layout(push_constant, scalar) uniform Push {
    uvec3 finerSize;
    uvec3 coarserSize;
    uint level;
} push;

// The or of each pair of adjacent bits, packed into the lower 16 bits.
uint orPairs(uint bits) {
    bits = (bits | bits >> 1) & 0x55555555u;
    bits = (bits | bits >> 1) & 0x33333333u;
    bits = (bits | bits >> 2) & 0x0f0f0f0fu;
    bits = (bits | bits >> 4) & 0x00ff00ffu;
    return (bits | bits >> 8) & 0xffffu;
}

void main() {
    const uint wordsPerRow = (push.coarserSize.x + 31u) / 32u;
    const uint word = linearIndex();
    if (word >= wordsPerRow * push.coarserSize.y * push.coarserSize.z) return;
    const uint row = word / wordsPerRow;
    const uint finerWord = 2u * (word % wordsPerRow);  // In its row.
    const uvec2 finerRow = 2u * uvec2(row % push.coarserSize.y, row / push.coarserSize.y);  // y and z.
    const uint finerPerRow = (push.finerSize.x + 31u) / 32u;
    uint low = 0u, high = 0u;
    for (uint z = finerRow.y; z < min(finerRow.y + 2u, push.finerSize.z); ++z)
        for (uint y = finerRow.x; y < min(finerRow.x + 2u, push.finerSize.y); ++y) {
            const uint first = (z * push.finerSize.y + y) * finerPerRow + finerWord;
            low |= finer.words[first];
            if (finerWord + 1u < finerPerRow) high |= finer.words[first + 1u];
        }
    const uint flags = orPairs(low) | orPairs(high) << 16;
    coarser.words[word] = flags;
    if (flags != 0u) atomicAdd(counts.cells[push.level], uint(bitCount(flags)));
}
