// Which leaves an update keeps, all beyond the region that is built again, and how many triangles each leaf has. A thread takes a word of
// the voxels' occupancy.
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

readonly buffer Region { uint words[]; } region;
readonly buffer Previous { uint words[]; } previous;
readonly buffer PreviousRank { uint before[]; } previousRank;
readonly buffer PreviousCounts { uint triangles[]; } previousCounts;
buffer Counted { uint triangles[]; } counted;  // As the walk over the region found; 0 of leaves that are kept.
writeonly buffer Counts { uint triangles[]; } counts;
writeonly buffer KeptFrom { uint leaf[]; } keptFrom;  // The number that a kept leaf had, NO_VOXEL for others.
buffer Rebuilt { uint leaves; } rebuilt;
layout(push_constant) uniform Push { uint words; } push;

void main() {
    const uint word = linearIndex();
    if (word >= push.words) return;
    const uint occupied = voxelOccupancy.words[word], within = region.words[word];
    uint number = voxelRank.before[word];
    for (uint bits = occupied; bits != 0u; bits &= bits - 1u) {
        const uint bit = bits & -bits;
        if ((within & bit) != 0u) {
            keptFrom.leaf[number] = NO_VOXEL;
            counts.triangles[number] = counted.triangles[number];
        } else {
            const uint before = previousRank.before[word] + uint(bitCount(previous.words[word] & (bit - 1u)));
            keptFrom.leaf[number] = before;
            counts.triangles[number] = previousCounts.triangles[before];
            counted.triangles[number] = 0u;
        }
        ++number;
    }
    if ((occupied & within) != 0u) atomicAdd(rebuilt.leaves, uint(bitCount(occupied & within)));
}
