// Averages the material of each surface group over its surfels: its mean normal and reflectance, and its fraction of
// the voxel's area at each face. A group has a patch at each face at which it has area.
//
// The voxel's unoccluded area is divided among unoccluded groups. Occluded groups exist only if each sample point has a
// surfel on either side of its surface; then each surfel has the same fraction of the voxel's whole area.
#include "passes/clusters/grouped_surfels.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(scalar) buffer Groups { SurfaceGroup data[]; } groups;
readonly buffer FirstGroup { uint data[]; } firstGroup;
layout(scalar) readonly buffer GroupMaterialsRef { VoxelMaterials groupMaterials; };
writeonly buffer PatchCounts { uint data[]; } patchCounts;  // Per group.
layout(push_constant) uniform Push { uint voxels; } push;

// Adds the projected area of a surfel at the three faces that its normal points to.
void addArea(vec3 normal, inout vec3 positive, inout vec3 negative) {
    const vec3 area = normal * normal;
    positive += mix(area, vec3(0.0), lessThan(normal, vec3(0.0)));
    negative += mix(vec3(0.0), area, lessThan(normal, vec3(0.0)));
}

vec3 fractionOf(vec3 groupSum, vec3 voxelSum, vec3 area) {
    return mix(area * groupSum / voxelSum, vec3(0.0), equal(groupSum, vec3(0.0)));
}

void main() {
    const uint voxel = linearIndex();
    if (voxel >= push.voxels) return;
    const uint first = firstGroup.data[voxel], end = firstGroup.data[voxel + 1u];
    vec3 voxelPositive = vec3(0.0), voxelNegative = vec3(0.0);
    float points = 0.0;
    for (uint group = first; group < end; ++group) {
        points += 0.5 * float(groups.data[group].surfelCount);
        for (uint i = 0u; i < groups.data[group].surfelCount && groups.data[group].isOccluded == 0u; ++i)
            addArea(groupedSurfels.data[groups.data[group].firstSurfel + i].normal, voxelPositive, voxelNegative);
    }
    const VoxelMaterial whole = voxelMaterial(voxel);
    for (uint group = first; group < end; ++group) {
        VoxelMaterial m = whole;
        vec3 positive = vec3(0.0), negative = vec3(0.0);
        m.albedo = m.normal = vec3(0.0);
        const uint surfelCount = groups.data[group].surfelCount;
        for (uint i = 0u; i < surfelCount; ++i) {
            const GroupedSurfel s = groupedSurfels.data[groups.data[group].firstSurfel + i];
            addArea(s.normal, positive, negative);
            m.albedo += s.reflectance / float(surfelCount);
            m.normal += s.normal / float(surfelCount);
        }
        if (groups.data[group].isOccluded == 1u) {
            m.unoccludedPositive = whole.area / points * positive;
            m.unoccludedNegative = whole.area / points * negative;
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
