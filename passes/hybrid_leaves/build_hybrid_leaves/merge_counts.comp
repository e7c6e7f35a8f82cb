// Merges the triangle counts of unchanged leaves, all outside the region, with those of rebuilt ones. One invocation
// per occupancy word.
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

readonly buffer Region { uint words[]; } region;
readonly buffer PreviousOccupancy { uint words[]; } previousOccupancy;
readonly buffer PreviousRank { uint before[]; } previousRank;
readonly buffer PreviousCounts { uint triangles[]; } previousCounts;
buffer RebuiltCounts { uint triangles[]; } rebuiltCounts;  // Counted in the region; set to 0 for unchanged leaves.
writeonly buffer Counts { uint triangles[]; } counts;
// Index of an unchanged leaf in the previous build, NO_VOXEL for others.
writeonly buffer PreviousLeaf { uint leaf[]; } previousLeaf;
buffer RebuiltLeaves { uint count; } rebuiltLeaves;
layout(push_constant) uniform Push { uint words; } push;

void main() {
    const uint word = linearIndex();
    if (word >= push.words) return;
    const uint occupied = voxelOccupancy.words[word], inRegion = region.words[word];
    uint leaf = voxelRank.before[word];
    for (uint bits = occupied; bits != 0u; bits &= bits - 1u) {
        const uint bit = bits & -bits;
        if ((inRegion & bit) != 0u) {
            previousLeaf.leaf[leaf] = NO_VOXEL;
            counts.triangles[leaf] = rebuiltCounts.triangles[leaf];
        } else {
            const uint previous =
                previousRank.before[word] + uint(bitCount(previousOccupancy.words[word] & (bit - 1u)));
            previousLeaf.leaf[leaf] = previous;
            counts.triangles[leaf] = previousCounts.triangles[previous];
            rebuiltCounts.triangles[leaf] = 0u;
        }
        ++leaf;
    }
    if ((occupied & inRegion) != 0u) atomicAdd(rebuiltLeaves.count, uint(bitCount(occupied & inRegion)));
}
