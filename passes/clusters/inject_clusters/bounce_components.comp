// One bounce between component faces (Cosin and Patow 2022, section 4.4): the radiosity of a face becomes that before the first bounce
// plus what its patches reflect of what they see. At most `maxSamples` patches stand for all: systematic sampling by area, with equal
// steps along the cumulated area. Faces with fewer patches use all of them.
#include "passes/clusters/inject_clusters/component_face_types.h"
#include "passes/clusters/gather_patch.glsl"
#include "passes/clusters/group_patches.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/sampling.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Groups { SurfaceGroup data[]; } groups;
layout(scalar) readonly buffer Components { ClusterComponent data[]; } components;
layout(scalar) readonly buffer MemberGroups { uint data[]; } memberGroups;
layout(scalar) readonly buffer ComponentFaces { ComponentFace data[]; } componentFaces;
layout(scalar) readonly buffer SendingFaces { uint data[]; } sendingFaces;        // 6 * component + face.
layout(scalar) readonly buffer InitialRadiosity { uint data[]; } initialRadiosity;  // By component and face, packed.
layout(scalar) writeonly buffer BouncedRadiosity { uint data[]; } bouncedRadiosity;  // What this bounce adds to it.
layout(scalar) writeonly buffer NewRadiosity { uint data[]; } newRadiosity;
layout(push_constant, scalar) uniform Push {
    VisibilityListLayout lists;
    uint faceCount;
    uint maxSamples;
    uint seed;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.faceCount) return;
    const uint number = sendingFaces.data[i], face = number % 6u;
    const ClusterComponent component = components.data[number / 6u];
    const ComponentFace componentFace = componentFaces.data[number];
    const bool usesAll = componentFace.patchCount <= push.maxSamples;
    const uint samples = min(componentFace.patchCount, push.maxSamples), end = component.firstMember + component.memberCount;
    const float step_ = componentFace.area / float(samples), begin = step_ * toUnit(hashCombine(push.seed, number));

    // Threads of a subgroup gather at once: each first searches its next patch
    vec3 sum = vec3(0.0);
    float cumulatedArea = 0.0, weightSum = 0.0;
    uint k = component.firstMember, group = NO_GROUP;
    for (uint s = 0u; s < samples; ++s) {
        bool isFound = group != NO_GROUP && !usesAll && cumulatedArea > begin + float(s) * step_;
        for (; k < end && !isFound; ++k) {
            const uint member = memberGroups.data[k];
            if (!hasPatch(groups.data[member], face)) continue;
            group = member;
            cumulatedArea += unoccluded(voxelMaterial(group), face);
            isFound = usesAll || cumulatedArea > begin + float(s) * step_;
        }
        const VoxelMaterial m = voxelMaterial(group);
        const float weight = usesAll ? unoccluded(m, face) : step_;
        sum += weight * m.albedo * gatherPatch(push.lists, patchIndex(groups.data[group], face));
        weightSum += weight;
    }
    sum /= weightSum;
    bouncedRadiosity.data[number] = packRadiosity(sum);
    newRadiosity.data[number] = packRadiosity(unpackRadiosity(initialRadiosity.data[number]) + sum);
}
