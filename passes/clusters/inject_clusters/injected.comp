// Irradiance of each patch: what was injected into its voxel. None where the injection did not look. Where that has less than
// SMALL_FACE_AREA, no more than its flux over so much: the ratio of two small samples could outshine a scene. A thread takes a side.
#include "passes/clusters/side_patches.glsl"
#include "shaders/compute/linear_index.glsl"
#include "passes/surfels/radiosity.glsl"
#include "shaders/voxels/packed_flux.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Sides { SurfaceSide data[]; } sides;
layout(scalar) buffer DirectAt { LargeUints direct; };
layout(scalar) buffer IndirectAt { LargeUints indirect; };
layout(scalar) readonly buffer Area { uint data[]; } area;
layout(scalar) readonly buffer PatchDirectAt { LargeUints patchDirect; };
layout(scalar) readonly buffer ArrivingAt { LargeUints arriving; };  // Direct and indirect, W/m².
layout(push_constant) uniform Push {
    uint sideCount;
    float voxelFaceArea;  // m²
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.sideCount) return;
    const SurfaceSide side = sides.data[i];
    for (uint k = 0u; k < 6u; ++k) {
        if (!hasPatch(side, k)) continue;
        const uint face = 6u * side.voxel + k, at = patchAt(side, k);
        const float sampled = areaOf(area.data[face / 2u], face);
        const float known = sampled > 0.0 ? max(sampled, SMALL_FACE_AREA) * push.voxelFaceArea : 0.0;
        const vec3 own = known > 0.0 ? loadFlux(direct, face) / known : vec3(0.0);
        patchDirect.data[at] = packRadiosity(own);
        arriving.data[at] = packRadiosity(known > 0.0 ? own + loadFlux(indirect, face) / known : vec3(0.0));
    }
}
