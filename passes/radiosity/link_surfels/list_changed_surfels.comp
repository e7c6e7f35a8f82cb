// Lists the surfels of a chunk that lie near a change.
#include "passes/common/compute/changed_boxes.glsl"
#include "passes/surfels/surfel_types.h"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Surfels { Surfel data[]; } surfels;
writeonly buffer ListedSurfels { uint data[]; } listedSurfels;
buffer ListedCount { uint value; } listedCount;
layout(push_constant) uniform Push {
    uint count;
    uint firstIndex;  // Of the chunk's surfels among all.
    float reach;      // m
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    if (isNearChange(surfels.data[i].position, push.reach)) listedSurfels.data[atomicAdd(listedCount.value, 1u)] = push.firstIndex + i;
}
