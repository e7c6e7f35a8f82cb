// Stores the index of each surface group's first patch; behind the last group, where patches end.
#include "passes/clusters/surface_group_types.h"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

readonly buffer FirstPatches { uint data[]; } firstPatches;
layout(scalar) buffer Groups { SurfaceGroup data[]; } groups;
layout(push_constant) uniform Push { uint groupCount; } push;

void main() {
    const uint group = linearIndex();
    if (group <= push.groupCount) groups.data[group].firstPatch = firstPatches.data[group];
}
