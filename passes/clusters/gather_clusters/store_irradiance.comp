// Stores flux and unoccluded area of voxels' faces: sums over the patches of their unoccluded surface groups. A
// thread processes a pair of opposite faces of a voxel.
#include "passes/clusters/group_materials.glsl"
#include "passes/clusters/group_patches.glsl"
#include "shaders/compute/linear_index.glsl"
#include "passes/surfels/radiosity.glsl"
#include "shaders/voxels/packed_flux.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer PatchValues { vec3 data[]; };
layout(scalar) readonly buffer Groups { SurfaceGroup data[]; } groups;
readonly buffer FirstGroup { uint data[]; } firstGroup;
#ifdef LISTED
readonly buffer NewVoxels { uint data[]; } newVoxels;
#endif
layout(scalar) readonly buffer GatheredRef { PatchValues gathered; };
layout(scalar) readonly buffer PatchDirectRef { LargeUints patchDirect; };
layout(scalar) buffer DirectRef { LargeUints direct; };
layout(scalar) buffer IndirectRef { LargeUints indirect; };
writeonly buffer Area { uint data[]; } area;
layout(push_constant) uniform Push {
    uint pairs;
    float voxelFaceArea;  // m²
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.pairs) return;
#ifdef LISTED
    const uint voxel = newVoxels.data[i / 3u];
#else
    const uint voxel = i / 3u;
#endif
    const uint axis = i % 3u, pair = 3u * voxel + axis;
    vec3 directFlux[2] = vec3[](vec3(0.0), vec3(0.0)), indirectFlux[2] = vec3[](vec3(0.0), vec3(0.0));
    float faceArea[2] = float[](0.0, 0.0);
    for (uint number = firstGroup.data[voxel]; number < firstGroup.data[voxel + 1u]; ++number) {
        const SurfaceGroup group = groups.data[number];
        if (isOccluded(group)) continue;
        const VoxelMaterial m = groupMaterial(number);
        for (uint k = 0u; k < 2u; ++k) {
            const uint face = 2u * axis + k;
            if (!hasPatch(group, face)) continue;
            const float patchArea = unoccluded(m, face);
            const uint patchNumber = patchIndex(group, face);
            faceArea[k] += patchArea;
            directFlux[k] += patchArea * push.voxelFaceArea * unpackRadiosity(patchDirect.data[patchNumber]);
            indirectFlux[k] += patchArea * push.voxelFaceArea * gathered.data[patchNumber];
        }
    }
    storeFlux(direct, pair, directFlux[0], directFlux[1]);
    storeFlux(indirect, pair, indirectFlux[0], indirectFlux[1]);
    area.data[pair] = packAreas(faceArea[0], faceArea[1]);
}
