// Stores the first member and the faces of each component; behind the last one, where members end.
#include "passes/clusters/surface_group_types.h"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Groups { SurfaceGroup data[]; } groups;
readonly buffer MemberGroups { uint data[]; } memberGroups;
readonly buffer FirstMembers { uint data[]; } firstMembers;  // One more than components.
layout(scalar) writeonly buffer Components { ClusterComponent data[]; } components;
writeonly buffer FaceCounts { uint data[]; } faceCounts;  // Likewise.
layout(push_constant) uniform Push { uint count; } push;

void main() {
    const uint i = linearIndex();
    if (i > push.count) return;
    const uint first = firstMembers.data[i], end = i < push.count ? firstMembers.data[i + 1u] : first;
    uint faces = 0u;
    for (uint k = first; k < end; ++k) faces |= groups.data[memberGroups.data[k]].flags & GROUP_FACES;
    components.data[i] = ClusterComponent(first, 0u, faces);
    faceCounts.data[i] = uint(bitCount(faces));
}
