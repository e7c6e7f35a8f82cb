// Computes the masks of children of a level's nodes from the flags of the next finer level. One invocation per word of
// four masks.
#include "shaders/compute/linear_index.glsl"
#include "shaders/octree/octree_cells.glsl"
layout(local_size_x = 64) in;

readonly buffer Flags { uint words[]; } flags;
readonly buffer Cells { uint data[]; } cells;
writeonly buffer Masks { uint words[]; } masks;
layout(push_constant, scalar) uniform Push {
    uvec3 finerSize;
    uint count;  // Nodes of the level.
} push;

bool isFlagged(uvec3 cell) {
    if (any(greaterThanEqual(cell, push.finerSize))) return false;
    const uint word = (cell.z * push.finerSize.y + cell.y) * ((push.finerSize.x + 31u) / 32u) + cell.x / 32u;
    return (flags.words[word] >> (cell.x & 31u) & 1u) != 0u;
}

void main() {
    const uint word = linearIndex();
    if (4u * word >= push.count) return;
    uint mask = 0u;
    for (uint i = 0u; i < min(4u, push.count - 4u * word); ++i) {
        const ivec3 first = 2 * unpackCell(cells.data[4u * word + i]);
        for (uint octant = 0u; octant < 8u; ++octant)
            if (isFlagged(uvec3(first + octantOffset(octant)))) mask |= 1u << (8u * i + octant);
    }
    masks.words[word] = mask;
}
