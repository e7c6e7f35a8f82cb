// Counts the lit patches that each voxel face sees: patches in its visibility list, and all lit patches at the faces of
// components in the list. Of several surface groups in a voxel, the one that sees the most counts.
#include "passes/view/show_voxels/lit_patch.glsl"
#include "passes/clusters/visibility_list.glsl"
#include "passes/clusters/group_patches.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Groups { SurfaceGroup data[]; } groups;
readonly buffer LitPatches { uint data[]; } litPatches;
buffer VisibleLitPatches { uint data[]; } visibleLitPatches;  // By voxel and face: the count plus 1; 0: no patch.
layout(push_constant, scalar) uniform Push {
    VisibilityListLayout listLayout;
    uint count;
} push;

uint countVisibleLit(uint number) {
    uint lit = 0u;
    for (VisibilityListIterator it = visibilityListOf(push.listLayout, number); nextEntry(it);) {
        if (it.target < push.listLayout.firstPatchTarget)
            lit += litPatches.data[it.target];
        else if (isLit(it.target - push.listLayout.firstPatchTarget))
            ++lit;
    }
    return lit;
}

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const SurfaceGroup group = groups.data[i];
    if (isOccluded(group)) return;
    uint patchNumber = group.firstPatch;
    for (uint face = 0u; face < 6u; ++face)
        if (hasPatch(group, face))
            atomicMax(visibleLitPatches.data[6u * group.voxel + face], countVisibleLit(patchNumber++) + 1u);
}
