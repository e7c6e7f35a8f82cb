// Gathers the irradiance of the patches of surface groups along their visibility lists.
#include "passes/clusters/gather_clusters/listed_groups.glsl"
#include "passes/clusters/gather_patch.glsl"
#include "passes/clusters/group_patches.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer PatchValues { vec3 data[]; };
layout(scalar) readonly buffer Groups { SurfaceGroup data[]; } groups;
layout(scalar) readonly buffer GatheredRef { PatchValues gathered; };  // W/m²
layout(push_constant, scalar) uniform Push {
    VisibilityListLayout lists;
    uint count;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const SurfaceGroup group = groups.data[groupIndex(i)];
    const uint end = group.firstPatch + uint(bitCount(group.faces));
    for (uint patchNumber = group.firstPatch; patchNumber < end; ++patchNumber)
        gathered.data[patchNumber] = gatherPatch(push.lists, patchNumber);
}
