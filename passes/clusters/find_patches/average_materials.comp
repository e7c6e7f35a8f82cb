// Averages the material of each surface group over its surfels: its mean normal, its reflectance and its area at each
// face. A surface's area is divided among the faces that its normal points to by the squares of the normal's
// components, whose sum is 1. A group has a patch at each face where it has area.
//
// The voxel's unoccluded area is divided among unoccluded groups. Occluded groups exist only with 'sides: all', where
// each sample point has two surfels, one on each side, and each has the voxel's area / the voxel's sample points.
#include "passes/clusters/find_patches/grouped_surfel.h"
#include "passes/clusters/group_materials.glsl"
#include "passes/clusters/group_patches.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(scalar) buffer Groups { SurfaceGroup data[]; } groups;
readonly buffer FirstGroup { uint data[]; } firstGroup;
writeonly buffer PatchCounts { uint data[]; } patchCounts;  // Per group.
layout(push_constant) uniform Push { uint voxelCount; } push;

// Divides a surfel's weight of 1 among the three faces that its normal points to, by the squares of its components.
void addFaceWeights(vec3 normal, inout vec3 positive, inout vec3 negative) {
    const vec3 weight = normal * normal;
    positive += mix(weight, vec3(0.0), lessThan(normal, vec3(0.0)));
    negative += mix(vec3(0.0), weight, lessThan(normal, vec3(0.0)));
}

vec3 shareOfArea(vec3 groupSum, vec3 voxelSum, vec3 area) {
    return mix(area * groupSum / voxelSum, vec3(0.0), equal(groupSum, vec3(0.0)));
}

void main() {
    const uint voxel = linearIndex();
    if (voxel >= push.voxelCount) return;
    const uint first = firstGroup.data[voxel], end = firstGroup.data[voxel + 1u];
    vec3 voxelPositive = vec3(0.0), voxelNegative = vec3(0.0);
    float samplePoints = 0.0;  // Half of the surfels: with 'sides: all' each point has two.
    for (uint number = first; number < end; ++number) {
        const SurfaceGroup group = groups.data[number];
        const uint endSurfel = groups.data[number + 1u].firstSurfel;
        samplePoints += 0.5 * float(endSurfel - group.firstSurfel);
        for (uint i = group.firstSurfel; i < endSurfel && !isOccluded(group); ++i)
            addFaceWeights(groupedSurfels.data[i].normal, voxelPositive, voxelNegative);
    }
    const VoxelMaterial whole = voxelMaterial(voxel);
    for (uint number = first; number < end; ++number) {
        const SurfaceGroup group = groups.data[number];
        VoxelMaterial m = whole;
        vec3 positive = vec3(0.0), negative = vec3(0.0);
        m.albedo = m.normal = vec3(0.0);
        const uint surfelCount = groups.data[number + 1u].firstSurfel - group.firstSurfel;
        for (uint i = 0u; i < surfelCount; ++i) {
            const GroupedSurfel s = groupedSurfels.data[group.firstSurfel + i];
            addFaceWeights(s.normal, positive, negative);
            m.albedo += s.reflectance / float(surfelCount);
            m.normal += s.normal / float(surfelCount);
        }
        if (isOccluded(group)) {
            // These members hold the area of occluded groups, too
            m.unoccludedPositive = whole.area / samplePoints * positive;
            m.unoccludedNegative = whole.area / samplePoints * negative;
        } else {
            m.unoccludedPositive = shareOfArea(positive, voxelPositive, whole.unoccludedPositive);
            m.unoccludedNegative = shareOfArea(negative, voxelNegative, whole.unoccludedNegative);
        }
        const PackedGroupMaterial packed = packGroupMaterial(m);
        groupMaterials.data[number] = packed;
        const VoxelMaterial stored = unpackGroupMaterial(packed);
        uint faces = 0u;
        for (uint face = 0u; face < 6u; ++face)
            if (unoccluded(stored, face) > 0.0) faces |= 1u << face;
        groups.data[number].flags = group.flags | faces;
        patchCounts.data[number] = uint(bitCount(faces));
    }
}
