// Where the arrays of the last build are, and which leaves an update keeps of it. A thread takes one of `count` items.
#include "shaders/compute/linear_index.glsl"
#include "passes/hybrid_leaves/hybrid_leaves.glsl"
layout(local_size_x = 64) in;

layout(push_constant, scalar) uniform Push {
    uint64_t words, primitives, gridBits, gridRanks, cells;
    uint count;
} push;

// A word of one of them.
uint previousWord(uint64_t array, uint at) { return LargeUints(array).data[at]; }

#define NOT_KEPT 0xffffffffu
