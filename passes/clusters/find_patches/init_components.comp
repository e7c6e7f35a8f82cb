// Stores the range of member groups of each component.
#include "passes/clusters/surface_group_types.h"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

readonly buffer MemberCounts { uint data[]; } memberCounts;
readonly buffer FirstMembers { uint data[]; } firstMembers;
layout(scalar) writeonly buffer Components { ClusterComponent data[]; } components;
layout(push_constant) uniform Push { uint count; } push;

void main() {
    const uint i = linearIndex();
    if (i < push.count) components.data[i] = ClusterComponent(firstMembers.data[i], memberCounts.data[i]);
}
