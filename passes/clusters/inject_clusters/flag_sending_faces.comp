// Sums the area of each component face, and sets a bit if it has area and sends light.
#include "passes/clusters/inject_clusters/component_face_types.h"
#include "passes/clusters/group_patches.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Groups { SurfaceGroup data[]; } groups;
layout(scalar) readonly buffer Components { ClusterComponent data[]; } components;
layout(scalar) readonly buffer MemberGroups { uint data[]; } memberGroups;
layout(scalar) writeonly buffer ComponentFaces { ComponentFace data[]; } componentFaces;
buffer Flags { uint words[]; } flags;  // Must be 0 before.
layout(push_constant) uniform Push { uint componentCount; } push;

void main() {
    const uint i = linearIndex();
    if (i >= push.componentCount) return;
    const ClusterComponent component = components.data[i];
    for (uint face = 0u; face < 6u; ++face) {
        ComponentFace componentFace = ComponentFace(0.0, 0u);
        for (uint k = component.firstMember; k < component.firstMember + component.memberCount; ++k) {
            const uint group = memberGroups.data[k];
            if (!hasPatch(groups.data[group], face)) continue;
            componentFace.area += unoccluded(voxelMaterial(group), face);
            ++componentFace.patchCount;
        }
        const uint index = 6u * i + face;
        componentFaces.data[index] = componentFace;
        if (componentFace.area > 0.0) atomicOr(flags.words[index / 32u], 1u << index % 32u);
    }
}
