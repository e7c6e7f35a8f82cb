// The first patch of each side, for when patches are numbered otherwise. A thread takes a side.
#include "passes/clusters/patch_types.h"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Sides { SurfaceSide data[]; } sides;
writeonly buffer FirstPatches { uint data[]; } firstPatches;
layout(push_constant) uniform Push { uint sideCount; } push;

void main() {
    const uint i = linearIndex();
    if (i < push.sideCount) firstPatches.data[i] = sides.data[i].firstPatch;
}
