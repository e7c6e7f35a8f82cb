#version 460
#extension GL_GOOGLE_include_directive : require
// How long each leaf's list is: 0 for leaves over the capacity. A thread takes a leaf.
#include "passes/build_hybrid_leaves/leaves_push.glsl"

readonly buffer Counts { uint triangles[]; } counts;
writeonly buffer Sizes { uint words[]; } sizes;
buffer Over { uint leaves; } over;  // The capacity.

void main() {
    const uint leaf = linearIndex();
    if (leaf >= push.leaves) return;
    const uint count = counts.triangles[leaf];
    if (count > push.capacity) atomicAdd(over.leaves, 1u);
    sizes.words[leaf] = count <= push.capacity ? count : 0u;
}
