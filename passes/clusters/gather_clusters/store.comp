// Irradiance of the faces of the open sides in a voxel (whose materials are bound) as its flux over their unoccluded area. A thread
// takes the two faces across an axis of a voxel; SEEN: of one that is listed.
#include "passes/clusters/side_patches.glsl"
#include "shaders/compute/linear_index.glsl"
#include "passes/surfels/radiosity.glsl"
#include "shaders/voxels/packed_flux.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer PatchValues { vec3 data[]; };
layout(scalar) readonly buffer Sides { SurfaceSide data[]; } sides;
readonly buffer FirstSide { uint data[]; } firstSide;
#ifdef SEEN
readonly buffer Found { uint data[]; } found;
#endif
layout(scalar) readonly buffer GatheredAt { PatchValues gathered; };
layout(scalar) readonly buffer PatchDirectAt { LargeUints patchDirect; };
layout(scalar) buffer DirectAt { LargeUints direct; };
layout(scalar) buffer IndirectAt { LargeUints indirect; };
writeonly buffer Area { uint data[]; } area;
layout(push_constant) uniform Push {
    uint pairs;
    float voxelFaceArea;  // m²
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.pairs) return;
#ifdef SEEN
    const uint voxel = found.data[i / 3u];
#else
    const uint voxel = i / 3u;
#endif
    const uint axis = i % 3u, pair = 3u * voxel + axis;
    vec3 directFlux[2] = vec3[](vec3(0.0), vec3(0.0)), indirectFlux[2] = vec3[](vec3(0.0), vec3(0.0));
    float own[2] = float[](0.0, 0.0);
    for (uint number = firstSide.data[voxel]; number < firstSide.data[voxel + 1u]; ++number) {
        const SurfaceSide side = sides.data[number];
        if (side.isCovered == 1u) continue;
        const VoxelMaterial m = voxelMaterial(number);
        for (uint k = 0u; k < 2u; ++k) {
            const uint face = 2u * axis + k;
            if (!hasPatch(side, face)) continue;
            const float part = unoccluded(m, face);
            const uint at = patchAt(side, face);
            own[k] += part;
            directFlux[k] += part * push.voxelFaceArea * unpackRadiosity(patchDirect.data[at]);
            indirectFlux[k] += part * push.voxelFaceArea * gathered.data[at];
        }
    }
    storeFlux(direct, pair, directFlux[0], directFlux[1]);
    storeFlux(indirect, pair, indirectFlux[0], indirectFlux[1]);
    area.data[pair] = packAreas(own[0], own[1]);
}
