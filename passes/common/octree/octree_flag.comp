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
    // x: index of a word
    const uvec3 finerCell = 2u * uvec3(word % wordsPerRow, row % push.coarserSize.y, row / push.coarserSize.y);
    const uint finerPerRow = (push.finerSize.x + 31u) / 32u;
    uint low = 0u, high = 0u;
    for (uint z = finerCell.z; z < min(finerCell.z + 2u, push.finerSize.z); ++z)
        for (uint y = finerCell.y; y < min(finerCell.y + 2u, push.finerSize.y); ++y) {
            const uint first = (z * push.finerSize.y + y) * finerPerRow + finerCell.x;
            low |= finer.words[first];
            if (finerCell.x + 1u < finerPerRow) high |= finer.words[first + 1u];
        }
    const uint flags = orPairs(low) | orPairs(high) << 16;
    coarser.words[word] = flags;
    if (flags != 0u) atomicAdd(counts.cells[push.level], uint(bitCount(flags)));
}
