// What the surfaces of a side are: of each face's area in the voxel the part that its surfels have; where it has any, it has a patch.
// Surfels of covered sides stand for what each point has of the surfaces' area, for then both sides of all points are surfels. A thread
// takes a voxel.
#include "passes/clusters/patches.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(scalar) buffer Sides { SurfaceSide data[]; } sides;
readonly buffer FirstSide { uint data[]; } firstSide;
layout(scalar) readonly buffer SideMaterialsAt { VoxelMaterials sideMaterials; };
writeonly buffer Counts { uint data[]; } counts;  // Of each side's patches.
layout(push_constant) uniform Push { uint voxels; } push;

// Area at faces of what looks along each axis, and against it.
void addArea(vec3 normal, inout vec3 positive, inout vec3 negative) {
    const vec3 area = normal * normal;
    positive += mix(area, vec3(0.0), lessThan(normal, vec3(0.0)));
    negative += mix(vec3(0.0), area, lessThan(normal, vec3(0.0)));
}

vec3 partOf(vec3 own, vec3 all, vec3 area) { return mix(area * own / all, vec3(0.0), equal(own, vec3(0.0))); }

void main() {
    const uint voxel = linearIndex();
    if (voxel >= push.voxels) return;
    const uint first = firstSide.data[voxel], end = firstSide.data[voxel + 1u];
    vec3 allPositive = vec3(0.0), allNegative = vec3(0.0);
    float points = 0.0;
    for (uint side = first; side < end; ++side) {
        points += 0.5 * float(sides.data[side].surfels);
        for (uint i = 0u; i < sides.data[side].surfels && sides.data[side].isCovered == 0u; ++i)
            addArea(patchSurfels.data[sides.data[side].firstSurfel + i].normal, allPositive, allNegative);
    }
    const VoxelMaterial whole = voxelMaterial(voxel);
    for (uint side = first; side < end; ++side) {
        VoxelMaterial m = whole;
        vec3 positive = vec3(0.0), negative = vec3(0.0);
        m.albedo = m.normal = vec3(0.0);
        const uint surfels = sides.data[side].surfels;
        for (uint i = 0u; i < surfels; ++i) {
            const PatchSurfel s = patchSurfels.data[sides.data[side].firstSurfel + i];
            addArea(s.normal, positive, negative);
            m.albedo += s.reflectance / float(surfels);
            m.normal += s.normal / float(surfels);
        }
        if (sides.data[side].isCovered == 1u) {
            m.unoccludedPositive = whole.area / points * positive;
            m.unoccludedNegative = whole.area / points * negative;
        } else {
            m.unoccludedPositive = partOf(positive, allPositive, whole.unoccludedPositive);
            m.unoccludedNegative = partOf(negative, allNegative, whole.unoccludedNegative);
        }
        m.area = dot(m.unoccludedPositive + m.unoccludedNegative, vec3(1.0));
        const PackedVoxelMaterial packed = packMaterial(m);
        sideMaterials.data[side] = packed;
        const VoxelMaterial stored = unpackMaterial(packed);
        uint faces = 0u;
        for (uint face = 0u; face < 6u; ++face)
            if (unoccluded(stored, face) > 0.0) faces |= 1u << face;
        sides.data[side].faces = faces;
        counts.data[side] = uint(bitCount(faces));
    }
}
