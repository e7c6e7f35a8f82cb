// Computes the radiosity of patches after bounces between components: the reflected initial irradiance of the patch
// plus the bounced radiosity of its component face. Small patches get the radiosity of their component face.
#include "passes/clusters/group_materials.glsl"
#include "passes/clusters/group_patches.glsl"
#include "shaders/compute/large_buffer.glsl"
#include "shaders/compute/linear_index.glsl"
#include "passes/surfels/radiosity.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Groups { SurfaceGroup data[]; } groups;
layout(scalar) readonly buffer Components { ClusterComponent data[]; } components;
layout(scalar) readonly buffer MemberGroups { uint data[]; } memberGroups;
layout(scalar) readonly buffer ComponentRadiosity { uint data[]; } componentRadiosity;  // Packed, per component face.
layout(scalar) readonly buffer BouncedRadiosity { uint data[]; } bouncedRadiosity;      // Sum of all bounces.
layout(scalar) readonly buffer InitialIrradianceRef { LargeUints initialIrradiance; };  // W/m², packed.
layout(scalar) readonly buffer RadiosityRef { LargeUints radiosity; };
layout(push_constant) uniform Push { uint componentCount; } push;

void main() {
    const uint i = linearIndex();
    if (i >= push.componentCount) return;
    const ClusterComponent component = components.data[i];
    const uint end = components.data[i + 1u].firstMember;
    for (uint k = component.firstMember; k < end; ++k) {
        const uint number = memberGroups.data[k];
        const SurfaceGroup group = groups.data[number];
        const VoxelMaterial m = groupMaterial(number);
        for (uint face = 0u; face < 6u; ++face) {
            if (!hasPatch(group, face)) continue;
            const uint patchNumber = patchIndex(group, face), target = componentFaceIndex(component, face);
            const vec3 reflected = m.albedo * unpackRadiosity(initialIrradiance.data[patchNumber]);
            radiosity.data[patchNumber] =
                unoccluded(m, face) < SMALL_FACE_AREA
                    ? componentRadiosity.data[target]
                    : packRadiosity(reflected + unpackRadiosity(bouncedRadiosity.data[target]));
        }
    }
}
