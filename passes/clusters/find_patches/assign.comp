// The part of each side, and what it is sorted by: sides without one come last. A thread takes a side.
#include "passes/clusters/patch_types.h"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

readonly buffer Labels { uint data[]; } labels;
readonly buffer Numbers { uint data[]; } numbers;
writeonly buffer OfSide { uint data[]; } ofSide;
writeonly buffer Keys { uint data[]; } keys;
writeonly buffer Members { uint data[]; } members;
layout(push_constant) uniform Push {
    uint sideCount;
    uint parts;
} push;

void main() {
    const uint side = linearIndex();
    if (side >= push.sideCount) return;
    const uint part = numbers.data[labels.data[side]];
    ofSide.data[side] = part;
    keys.data[side] = min(part, push.parts);
    members.data[side] = side;
}
