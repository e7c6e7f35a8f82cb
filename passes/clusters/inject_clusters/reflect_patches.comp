// Computes the radiosity of each patch: reflectance of its surface group (whose materials are bound) times irradiance.
#include "passes/clusters/group_patches.glsl"
#include "shaders/compute/linear_index.glsl"
#include "passes/surfels/radiosity.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Groups { SurfaceGroup data[]; } groups;
layout(scalar) readonly buffer InitialIrradianceRef { LargeUints initialIrradiance; };  // W/m², packed.
layout(scalar) readonly buffer BouncedIrradianceRef { LargeUints bouncedIrradiance; };  // From bounces, likewise.
layout(scalar) readonly buffer RadiosityRef { LargeUints radiosity; };
layout(push_constant) uniform Push {
    uint groupCount;
    uint hasBounced;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.groupCount) return;
    const SurfaceGroup group = groups.data[i];
    const vec3 albedo = voxelMaterial(i).albedo;
    const uint end = group.firstPatch + uint(bitCount(group.faces));
    for (uint patchNumber = group.firstPatch; patchNumber < end; ++patchNumber) {
        vec3 irradiance = unpackRadiosity(initialIrradiance.data[patchNumber]);
        if (push.hasBounced == 1u) irradiance += unpackRadiosity(bouncedIrradiance.data[patchNumber]);
        radiosity.data[patchNumber] = packRadiosity(albedo * irradiance);
    }
}
