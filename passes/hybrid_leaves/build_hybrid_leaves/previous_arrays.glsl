// Arrays of the previous build, by address.
#include "shaders/compute/linear_index.glsl"
#include "passes/hybrid_leaves/hybrid_leaves.glsl"
layout(local_size_x = 64) in;

layout(push_constant, scalar) uniform Push {
    uint64_t words, primitives, gridBits, gridRanks, cells;
    uint count;
} push;

uint previousWord(uint64_t array, uint index) { return LargeUints(array).data[index]; }

#define NO_PREVIOUS 0xffffffffu  // Of a leaf or grid that is rebuilt.
