// Lists the faces of components, and sums their areas.
#include "passes/clusters/inject_clusters/component_face_types.h"
#include "passes/clusters/group_materials.glsl"
#include "passes/clusters/group_patches.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Groups { SurfaceGroup data[]; } groups;
layout(scalar) readonly buffer Components { ClusterComponent data[]; } components;
layout(scalar) readonly buffer MemberGroups { uint data[]; } memberGroups;
layout(scalar) writeonly buffer ComponentFaces { ComponentFace data[]; } componentFaces;
layout(push_constant) uniform Push { uint componentCount; } push;

void main() {
    const uint i = linearIndex();
    if (i >= push.componentCount) return;
    const ClusterComponent component = components.data[i];
    const uint end = components.data[i + 1u].firstMember;
    for (uint face = 0u; face < 6u; ++face) {
        if (!hasFace(component, face)) continue;
        ComponentFace componentFace = ComponentFace(6u * i + face, 0u, 0.0);
        for (uint k = component.firstMember; k < end; ++k) {
            const uint group = memberGroups.data[k];
            if (!hasPatch(groups.data[group], face)) continue;
            componentFace.area += unoccluded(groupMaterial(group), face);
            ++componentFace.patchCount;
        }
        componentFaces.data[componentFaceIndex(component, face)] = componentFace;
    }
}
