// Irradiance of the patches of all sides; SEEN: of those that are listed. A thread takes a side.
#include "passes/clusters/gather_clusters/which_sides.glsl"
#include "passes/clusters/gather_patch.glsl"
#include "passes/clusters/side_patches.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer PatchValues { vec3 data[]; };
layout(scalar) readonly buffer Sides { SurfaceSide data[]; } sides;
layout(scalar) readonly buffer GatheredAt { PatchValues gathered; };  // W/m²
layout(push_constant, scalar) uniform Push {
    SeenLayout lists;
    uint count;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const SurfaceSide side = sides.data[sideNumber(i)];
    const uint end = side.firstPatch + uint(bitCount(side.faces));
    for (uint at = side.firstPatch; at < end; ++at) gathered.data[at] = gatherPatch(push.lists, at);
}
