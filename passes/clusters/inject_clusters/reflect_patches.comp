// Computes the radiosity of each patch: reflectance of its surface group times irradiance.
#include "passes/clusters/group_materials.glsl"
#include "shaders/compute/linear_index.glsl"
#include "passes/surfels/radiosity.glsl"
#include "shaders/compute/large_buffer.glsl"
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
    const vec3 albedo = groupMaterial(i).albedo;
    const uint end = groups.data[i + 1u].firstPatch;
    for (uint patchNumber = groups.data[i].firstPatch; patchNumber < end; ++patchNumber) {
        vec3 irradiance = unpackRadiosity(initialIrradiance.data[patchNumber]);
        if (push.hasBounced == 1u) irradiance += unpackRadiosity(bouncedIrradiance.data[patchNumber]);
        radiosity.data[patchNumber] = packRadiosity(albedo * irradiance);
    }
}
