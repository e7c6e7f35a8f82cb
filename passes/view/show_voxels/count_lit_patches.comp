// Counts the directly lit patches at each face of each cluster component that has any patches there.
#include "passes/view/show_voxels/lit_patch.glsl"
#include "passes/clusters/group_patches.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Groups { SurfaceGroup data[]; } groups;
layout(scalar) readonly buffer Components { ClusterComponent data[]; } components;
layout(scalar) readonly buffer MemberGroups { uint data[]; } memberGroups;
writeonly buffer LitPatches { uint data[]; } litPatches;  // Per component face.
layout(push_constant) uniform Push { uint count; } push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const ClusterComponent component = components.data[i];
    uint lit[6] = uint[](0u, 0u, 0u, 0u, 0u, 0u);
    for (uint k = component.firstMember; k < components.data[i + 1u].firstMember; ++k) {
        const SurfaceGroup group = groups.data[memberGroups.data[k]];
        for (uint face = 0u; face < 6u; ++face)
            if (hasPatch(group, face) && isLit(patchIndex(group, face))) ++lit[face];
    }
    for (uint face = 0u; face < 6u; ++face)
        if ((component.faces >> face & 1u) != 0u) litPatches.data[componentFaceIndex(component, face)] = lit[face];
}
