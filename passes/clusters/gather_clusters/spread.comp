// Lists the sides round those of the last step, which a step of the filter reads. A thread takes one of those.
#include "passes/clusters/patch_types.h"
#include "shaders/compute/large_buffer.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

readonly buffer FirstNeighbour { uint data[]; } firstNeighbour;
layout(scalar) readonly buffer NeighboursAt { LargeUints neighbours; };
buffer Reached { uint data[]; } reached;
buffer Listed { uint data[]; } listed;
buffer Count { uint value; } count;
layout(push_constant) uniform Push {
    uint first;  // Of `listed`.
    uint sideCount;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.sideCount) return;
    const uint side = listed.data[push.first + i];
    for (uint k = firstNeighbour.data[side]; k < firstNeighbour.data[side + 1u]; ++k) {
        const uint other = neighbours.data[k];
        if (other != NO_SIDE && atomicExchange(reached.data[other], 1u) == 0u) listed.data[atomicAdd(count.value, 1u)] = other;
    }
}
