// Averages the radiosity of component faces over their patches, weighted by area (Cosin and Patow 2022, section 4.4:
// irradiance is pulled up to clusters). The order of summation is the same in
// each run. Patches smaller than SMALL_FACE_AREA, whose radiosity is a ratio of two small samples and may be much too
// bright, get the mean.
#include "passes/clusters/group_materials.glsl"
#include "passes/clusters/group_patches.glsl"
#include "shaders/compute/linear_index.glsl"
#include "passes/surfels/radiosity.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Groups { SurfaceGroup data[]; } groups;
layout(scalar) readonly buffer Components { ClusterComponent data[]; } components;
layout(scalar) readonly buffer MemberGroups { uint data[]; } memberGroups;
layout(scalar) readonly buffer RadiosityRef { LargeUints radiosity; };
layout(scalar) writeonly buffer ComponentRadiosity { uint data[]; } componentRadiosity;
layout(push_constant) uniform Push { uint count; } push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const ClusterComponent component = components.data[i];
    const uint first = component.firstMember, end = components.data[i + 1u].firstMember;
    for (uint face = 0u; face < 6u; ++face) {
        if (!hasFace(component, face)) continue;
        vec3 sum = vec3(0.0);
        float totalArea = 0.0;
        for (uint k = first; k < end; ++k) {
            const uint group = memberGroups.data[k];
            if (!hasPatch(groups.data[group], face)) continue;
            const float area = unoccluded(groupMaterial(group), face);
            sum += area * unpackRadiosity(radiosity.data[patchIndex(groups.data[group], face)]);
            totalArea += area;
        }
        const uint mean = packRadiosity(totalArea > 0.0 ? sum / totalArea : vec3(0.0));
        componentRadiosity.data[componentFaceIndex(component, face)] = mean;
        for (uint k = first; k < end; ++k) {
            const uint group = memberGroups.data[k];
            if (hasPatch(groups.data[group], face) && unoccluded(groupMaterial(group), face) < SMALL_FACE_AREA)
                radiosity.data[patchIndex(groups.data[group], face)] = mean;
        }
    }
}
