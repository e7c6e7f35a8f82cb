// How many patches at each face of each part of a cluster light arrives at straight from the lights.
#include "passes/view/show_voxels/lit_patch.glsl"
#include "passes/clusters/side_patches.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Sides { SurfaceSide data[]; } sides;
layout(scalar) readonly buffer Parts { ClusterPart data[]; } parts;
layout(scalar) readonly buffer Members { uint data[]; } members;
writeonly buffer LitOfParts { uint data[]; } litOfParts;  // 6 a part.
layout(push_constant) uniform Push { uint count; } push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const ClusterPart part = parts.data[i];
    uint lit[6] = uint[](0u, 0u, 0u, 0u, 0u, 0u);
    for (uint k = part.firstMember; k < part.firstMember + part.members; ++k) {
        const SurfaceSide side = sides.data[members.data[k]];
        for (uint face = 0u; face < 6u; ++face)
            if (hasPatch(side, face) && isLit(patchAt(side, face))) ++lit[face];
    }
    for (uint face = 0u; face < 6u; ++face) litOfParts.data[6u * i + face] = lit[face];
}
