// Stores the first patch of each surface group for the next update, in which patches get new indices.
#include "passes/clusters/surface_group_types.h"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Groups { SurfaceGroup data[]; } groups;
writeonly buffer FirstPatches { uint data[]; } firstPatches;
layout(push_constant) uniform Push { uint groupCount; } push;

void main() {
    const uint i = linearIndex();
    if (i < push.groupCount) firstPatches.data[i] = groups.data[i].firstPatch;
}
