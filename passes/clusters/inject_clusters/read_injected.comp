// Reads the irradiance of each patch that was injected into its voxel: flux over area, 0 where the area is 0. Areas are
// clamped to SMALL_FACE_AREA: the ratio of two small samples may be much too bright.
#include "passes/clusters/group_patches.glsl"
#include "shaders/compute/linear_index.glsl"
#include "passes/surfels/radiosity.glsl"
#include "shaders/voxels/packed_flux.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Groups { SurfaceGroup data[]; } groups;
layout(scalar) buffer DirectRef { LargeUints direct; };
layout(scalar) buffer IndirectRef { LargeUints indirect; };
layout(scalar) readonly buffer Area { uint data[]; } area;
layout(scalar) readonly buffer PatchDirectRef { LargeUints patchDirect; };
layout(scalar) readonly buffer InitialIrradianceRef { LargeUints initialIrradiance; };  // Direct and indirect, W/m².
layout(push_constant) uniform Push {
    uint groupCount;
    float voxelFaceArea;  // m²
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.groupCount) return;
    const SurfaceGroup group = groups.data[i];
    for (uint face = 0u; face < 6u; ++face) {
        if (!hasPatch(group, face)) continue;
        const uint voxelFace = 6u * group.voxel + face, patchNumber = patchIndex(group, face);
        const float sampledArea = areaOf(area.data[voxelFace / 2u], voxelFace);
        const float faceArea = sampledArea > 0.0 ? max(sampledArea, SMALL_FACE_AREA) * push.voxelFaceArea : 0.0;
        const vec3 directIrradiance = faceArea > 0.0 ? loadFlux(direct, voxelFace) / faceArea : vec3(0.0);
        patchDirect.data[patchNumber] = packRadiosity(directIrradiance);
        initialIrradiance.data[patchNumber] =
            packRadiosity(faceArea > 0.0 ? directIrradiance + loadFlux(indirect, voxelFace) / faceArea : vec3(0.0));
    }
}
