// One bounce between component faces (Cosin and Patow 2022, section 4.4): the new radiosity of a face is the initial
// one plus the light that its patches receive along their visibility lists and reflect. At most `maxSamples` patches
// are evaluated, by systematic sampling with equal steps along the cumulative area; of faces with fewer patches all.
#include "passes/clusters/inject_clusters/component_face_types.h"
#include "passes/clusters/gather_patch.glsl"
#include "passes/clusters/group_materials.glsl"
#include "passes/clusters/group_patches.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/sampling.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Groups { SurfaceGroup data[]; } groups;
layout(scalar) readonly buffer Components { ClusterComponent data[]; } components;
layout(scalar) readonly buffer MemberGroups { uint data[]; } memberGroups;
layout(scalar) readonly buffer ComponentFaces { ComponentFace data[]; } componentFaces;
layout(scalar) readonly buffer InitialRadiosity { uint data[]; } initialRadiosity;  // Per component face, packed.
layout(scalar) writeonly buffer BouncedRadiosity { uint data[]; } bouncedRadiosity;  // What this bounce adds.
layout(scalar) writeonly buffer NewRadiosity { uint data[]; } newRadiosity;
layout(push_constant, scalar) uniform Push {
    VisibilityListLayout listLayout;
    uint faceCount;
    uint maxSamples;
    uint seed;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.faceCount) return;
    const ComponentFace componentFace = componentFaces.data[i];
    const uint component = componentFace.number / 6u, face = componentFace.number % 6u;
    const uint end = components.data[component + 1u].firstMember;
    const bool usesAll = componentFace.patchCount <= push.maxSamples;
    const uint samples = min(componentFace.patchCount, push.maxSamples);
    const float step_ = componentFace.area / float(samples), offset = step_ * toUnit(hashCombine(push.seed, componentFace.number));

    // Each thread first finds its next patch, so that all threads of a subgroup gather at the same time
    vec3 sum = vec3(0.0);
    float cumulativeArea = 0.0, weightSum = 0.0;
    uint k = components.data[component].firstMember, group = NO_GROUP;
    for (uint s = 0u; s < samples; ++s) {
        bool isFound = group != NO_GROUP && !usesAll && cumulativeArea > offset + float(s) * step_;
        for (; k < end && !isFound; ++k) {
            const uint member = memberGroups.data[k];
            if (!hasPatch(groups.data[member], face)) continue;
            group = member;
            cumulativeArea += unoccluded(groupMaterial(group), face);
            isFound = usesAll || cumulativeArea > offset + float(s) * step_;
        }
        const VoxelMaterial m = groupMaterial(group);
        const float weight = usesAll ? unoccluded(m, face) : step_;
        sum += weight * m.albedo * gatherPatch(push.listLayout, patchIndex(groups.data[group], face));
        weightSum += weight;
    }
    sum /= weightSum;
    bouncedRadiosity.data[i] = packRadiosity(sum);
    newRadiosity.data[i] = packRadiosity(unpackRadiosity(initialRadiosity.data[i]) + sum);
}
