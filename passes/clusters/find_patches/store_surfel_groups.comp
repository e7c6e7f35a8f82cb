// Stores the group of each surfel for the next update, indexed by the surfel's id.
#include "passes/clusters/find_patches/grouped_surfel.h"
#include "passes/clusters/find_patches/stored_group.h"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer StoredGroupsRef { StoredGroups storedGroups; };
layout(push_constant) uniform Push { uint surfels; } push;

void main() {
    const uint i = linearIndex();
    if (i >= push.surfels) return;
    const GroupedSurfel s = groupedSurfels.data[i];
    storedGroups.data[s.id] = StoredGroup(s.group, s.height);
}
