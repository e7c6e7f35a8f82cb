// Averages the material of each surface group over its surfels: its mean normal and reflectance and, for each face, its
// share of the voxel's projected area. A group has a patch at each face onto which it projects area.
//
// The voxel's unoccluded area is divided among unoccluded groups. Occluded groups exist only with 'sides: all', where
// each sample point has two surfels. Each of them stands for area / number of points.
#include "passes/clusters/grouped_surfels.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(scalar) buffer Groups { SurfaceGroup data[]; } groups;
readonly buffer FirstGroup { uint data[]; } firstGroup;
layout(scalar) readonly buffer GroupMaterialsRef { VoxelMaterials groupMaterials; };
writeonly buffer PatchCounts { uint data[]; } patchCounts;  // Per group.
layout(push_constant) uniform Push { uint voxels; } push;

// Divides a surfel's weight of 1 among the three faces that its normal points to, by the squares of its components.
void addFaceWeights(vec3 normal, inout vec3 positive, inout vec3 negative) {
    const vec3 weight = normal * normal;
    positive += mix(weight, vec3(0.0), lessThan(normal, vec3(0.0)));
    negative += mix(vec3(0.0), weight, lessThan(normal, vec3(0.0)));
}

vec3 fractionOf(vec3 groupSum, vec3 voxelSum, vec3 area) {
    return mix(area * groupSum / voxelSum, vec3(0.0), equal(groupSum, vec3(0.0)));
}

void main() {
    const uint voxel = linearIndex();
    if (voxel >= push.voxels) return;
    const uint first = firstGroup.data[voxel], end = firstGroup.data[voxel + 1u];
    vec3 voxelPositive = vec3(0.0), voxelNegative = vec3(0.0);
    float samplePoints = 0.0;  // Half of the surfels: with 'sides: all' each point has two.
    for (uint group = first; group < end; ++group) {
        samplePoints += 0.5 * float(groups.data[group].surfelCount);
        for (uint i = 0u; i < groups.data[group].surfelCount && groups.data[group].isOccluded == 0u; ++i)
            addFaceWeights(groupedSurfels.data[groups.data[group].firstSurfel + i].normal, voxelPositive,
                           voxelNegative);
    }
    const VoxelMaterial whole = voxelMaterial(voxel);
    for (uint group = first; group < end; ++group) {
        VoxelMaterial m = whole;
        vec3 positive = vec3(0.0), negative = vec3(0.0);
        m.albedo = m.normal = vec3(0.0);
        const uint surfelCount = groups.data[group].surfelCount;
        for (uint i = 0u; i < surfelCount; ++i) {
            const GroupedSurfel s = groupedSurfels.data[groups.data[group].firstSurfel + i];
            addFaceWeights(s.normal, positive, negative);
            m.albedo += s.reflectance / float(surfelCount);
            m.normal += s.normal / float(surfelCount);
        }
        if (groups.data[group].isOccluded == 1u) {
            // These members hold the area of occluded groups, too
            m.unoccludedPositive = whole.area / samplePoints * positive;
            m.unoccludedNegative = whole.area / samplePoints * negative;
        } else {
            m.unoccludedPositive = fractionOf(positive, voxelPositive, whole.unoccludedPositive);
            m.unoccludedNegative = fractionOf(negative, voxelNegative, whole.unoccludedNegative);
        }
        m.area = dot(m.unoccludedPositive + m.unoccludedNegative, vec3(1.0));
        const PackedVoxelMaterial packed = packMaterial(m);
        groupMaterials.data[group] = packed;
        const VoxelMaterial stored = unpackMaterial(packed);
        uint faces = 0u;
        for (uint face = 0u; face < 6u; ++face)
            if (unoccluded(stored, face) > 0.0) faces |= 1u << face;
        groups.data[group].faces = faces;
        patchCounts.data[group] = uint(bitCount(faces));
    }
}
