// Writes the component of each surface group, and sort keys by which groups without a component come last.
#include "passes/clusters/surface_group_types.h"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

readonly buffer Labels { uint data[]; } labels;
readonly buffer ComponentOfRoot { uint data[]; } componentOfRoot;
writeonly buffer ComponentOfGroup { uint data[]; } componentOfGroup;
writeonly buffer Keys { uint data[]; } keys;
writeonly buffer MemberGroups { uint data[]; } memberGroups;
layout(push_constant) uniform Push {
    uint groupCount;
    uint components;
} push;

void main() {
    const uint group = linearIndex();
    if (group >= push.groupCount) return;
    const uint component = componentOfRoot.data[labels.data[group]];
    componentOfGroup.data[group] = component;
    keys.data[group] = min(component, push.components);
    memberGroups.data[group] = group;
}
