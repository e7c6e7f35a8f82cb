// Gathers the irradiance of the patches of surface groups along their visibility lists.
#include "passes/clusters/gather_clusters/listed_groups.glsl"
#include "passes/clusters/gather_patch.glsl"
#include "passes/clusters/surface_group_types.h"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer PatchValues { vec3 data[]; };
layout(scalar) readonly buffer Groups { SurfaceGroup data[]; } groups;
layout(scalar) readonly buffer GatheredRef { PatchValues gathered; };  // W/m²
layout(push_constant, scalar) uniform Push {
    VisibilityListLayout listLayout;
    uint count;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const uint group = groupIndex(i), end = groups.data[group + 1u].firstPatch;
    for (uint patchNumber = groups.data[group].firstPatch; patchNumber < end; ++patchNumber)
        gathered.data[patchNumber] = gatherPatch(push.listLayout, patchNumber);
}
