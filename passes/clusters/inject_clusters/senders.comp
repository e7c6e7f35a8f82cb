// Which faces of parts send light: those at which the part has area. A thread takes a part.
#include "passes/clusters/inject_clusters/part_face_types.h"
#include "passes/clusters/side_patches.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Sides { SurfaceSide data[]; } sides;
layout(scalar) readonly buffer Parts { ClusterPart data[]; } parts;
layout(scalar) readonly buffer Members { uint data[]; } members;
layout(scalar) writeonly buffer PartFaces { PartFace data[]; } partFaces;
buffer Flags { uint words[]; } flags;  // Zero before.
layout(push_constant) uniform Push { uint partCount; } push;

void main() {
    const uint i = linearIndex();
    if (i >= push.partCount) return;
    const ClusterPart part = parts.data[i];
    for (uint face = 0u; face < 6u; ++face) {
        PartFace own = PartFace(0.0, 0u);
        for (uint k = part.firstMember; k < part.firstMember + part.members; ++k) {
            const uint side = members.data[k];
            if (!hasPatch(sides.data[side], face)) continue;
            own.area += unoccluded(voxelMaterial(side), face);
            ++own.patches;
        }
        const uint at = 6u * i + face;
        partFaces.data[at] = own;
        if (own.area > 0.0) atomicOr(flags.words[at / 32u], 1u << at % 32u);
    }
}
