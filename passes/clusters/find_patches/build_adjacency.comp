// Counts the candidates for neighbors of each surface group: groups in the 26 adjacent voxels that have area
// at the face of the same direction, and are both occluded or both unoccluded. LIST: stores them. Rays test their
// visibility later.
#include "passes/clusters/group_materials.glsl"
#include "passes/clusters/group_patches.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Coordinates { uvec3 data[]; } coordinates;
layout(scalar) readonly buffer Groups { SurfaceGroup data[]; } groups;
readonly buffer FirstGroup { uint data[]; } firstGroup;
#ifdef LIST
readonly buffer FirstCandidate { uint data[]; } firstCandidate;
layout(scalar) readonly buffer CandidatesRef { LargeUints candidates; };
layout(scalar) readonly buffer GroupOfCandidateRef { LargeUints groupOfCandidate; };
#else
// One for each group, then a 0, which the prefix sum replaces by the total.
writeonly buffer Counts { uint data[]; } counts;
#endif
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint groupCount;
} push;

// Of occluded groups these members are the occluded area.
bool haveAreaAtSameFace(VoxelMaterial a, VoxelMaterial b) {
    const vec3 area = min(a.unoccludedPositive, b.unoccludedPositive) + min(a.unoccludedNegative, b.unoccludedNegative);
    return any(greaterThan(area, vec3(0.0)));
}

void main() {
    const uint group = linearIndex();
    if (group > push.groupCount) return;
    uint count = 0u;
    if (group < push.groupCount) {
        const VoxelMaterial m = groupMaterial(group);
        const ivec3 center = ivec3(coordinates.data[groups.data[group].voxel]);
        for (int i = 0; i < 27; ++i) {
            const uint voxel = voxelNumber(push.grid, center + ivec3(i % 3, i / 3 % 3, i / 9) - 1);
            if (i == 13 || voxel == NO_VOXEL) continue;
            for (uint neighbor = firstGroup.data[voxel]; neighbor < firstGroup.data[voxel + 1u]; ++neighbor) {
                if (isOccluded(groups.data[neighbor]) != isOccluded(groups.data[group])) continue;
                if (!haveAreaAtSameFace(m, groupMaterial(neighbor))) continue;
#ifdef LIST
                candidates.data[firstCandidate.data[group] + count] = neighbor;
                groupOfCandidate.data[firstCandidate.data[group] + count] = group;
#endif
                ++count;
            }
        }
    }
#ifndef LIST
    counts.data[group] = count;
#endif
}
