// Radiosity of patches after bounces between parts: their own of the light that the bounces began with, and the part's bounced light.
// A thread takes a part; no patch is in two.
#include "passes/clusters/side_patches.glsl"
#include "shaders/compute/large_buffer.glsl"
#include "shaders/compute/linear_index.glsl"
#include "passes/surfels/radiosity.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Sides { SurfaceSide data[]; } sides;
layout(scalar) readonly buffer Parts { ClusterPart data[]; } parts;
layout(scalar) readonly buffer Members { uint data[]; } members;
layout(scalar) readonly buffer Sent { uint data[]; } sent;        // By the part's faces, packed.
layout(scalar) readonly buffer Bounced { uint data[]; } bounced;  // Likewise.
layout(scalar) readonly buffer ArrivingAt { LargeUints arriving; };  // Irradiance before the first bounce, W/m², packed.
layout(scalar) readonly buffer RadiosityAt { LargeUints radiosity; };
layout(push_constant) uniform Push { uint partCount; } push;

void main() {
    const uint i = linearIndex();
    if (i >= push.partCount) return;
    const ClusterPart part = parts.data[i];
    for (uint k = part.firstMember; k < part.firstMember + part.members; ++k) {
        const uint number = members.data[k];
        const SurfaceSide side = sides.data[number];
        const VoxelMaterial m = voxelMaterial(number);
        for (uint face = 0u; face < 6u; ++face) {
            if (!hasPatch(side, face)) continue;
            const uint at = patchAt(side, face), from = 6u * i + face;
            radiosity.data[at] =
                unoccluded(m, face) < SMALL_FACE_AREA
                    ? sent.data[from]
                    : packRadiosity(m.albedo * unpackRadiosity(arriving.data[at]) + unpackRadiosity(bounced.data[from]));
        }
    }
}
