// A word of the key of each cell, to sort cells by: the lower one (0) first.
#include "shaders/compute/linear_index.glsl"
#include "shaders/shared/types.h"
layout(local_size_x = 64) in;

readonly buffer Cells { uint data[]; } cells;  // Slots.
layout(scalar) readonly buffer CellKeys { uint64_t data[]; } cellKeys;
writeonly buffer Words { uint data[]; } words;
layout(push_constant) uniform Push {
    uint count;
    uint word;
} push;

void main() {
    const uint i = linearIndex();
    if (i < push.count) words.data[i] = uint(cellKeys.data[cells.data[i]] >> (32u * push.word));
}
