// Iterates over the occupied voxels in a box, and computes the distance of a voxel from a cluster.
#include "passes/clusters/cluster_types.h"
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxels/voxels.glsl"

layout(scalar) readonly buffer Normals { vec3 data[]; } normals;  // Per voxel, unit length.
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint count;       // Seeds or voxels: one for each thread.
    float searchRadius;  // Voxels: largest distance of voxels from their cluster's center along each axis.
    float minCosine;  // Cosine of the largest angle between a cluster's normal and those of its voxels.
    uint firstInRandomOrder;  // 1: ClusterAssignment::FirstInRandomOrder. 0: ClusterAssignment::Nearest.
    uint seedCount;
} push;

// Iterates over the occupied voxels of a box by the words of the occupancy bits, which hold 32 voxels along x:
// for (BoxIterator it = voxelsInBox(first, last); nextVoxel(it);).
struct BoxIterator {
    ivec3 first, last;  // Corners of the box, inclusive.
    ivec3 nextWord;     // Index of the next word in its row, and the row.
    uint wordIndex;     // Index of the current word.
    uint word;          // The current word.
    uint remaining;     // Its bits in the box that have not been visited yet.
    ivec3 voxel;        // Coordinates of the current voxel.
    uint number;        // Its number.
};

BoxIterator voxelsInBox(ivec3 first, ivec3 last) {
    BoxIterator it;
    it.first = first;
    it.last = last;
    it.nextWord = ivec3(first.x >> 5, first.yz);
    it.remaining = 0u;
    return it;
}

bool nextVoxel(inout BoxIterator it) {
    if (any(greaterThan(it.first, it.last))) return false;
    while (it.remaining == 0u) {
        if (it.nextWord.z > it.last.z) return false;
        const int low = max(it.first.x - 32 * it.nextWord.x, 0), high = min(it.last.x - 32 * it.nextWord.x, 31);
        const uint row = uint(it.nextWord.z * int(push.grid.resolution.y) + it.nextWord.y);
        it.wordIndex = row * push.grid.wordsPerRow + uint(it.nextWord.x);
        it.word = voxelOccupancy.words[it.wordIndex];
        it.remaining = it.word & (0xffffffffu << low) & (0xffffffffu >> (31 - high));
        it.voxel = ivec3(32 * it.nextWord.x, it.nextWord.yz);
        if (++it.nextWord.x > it.last.x >> 5) it.nextWord = ivec3(it.first.x >> 5, it.nextWord.y + 1, it.nextWord.z);
        if (it.nextWord.y > it.last.y) it.nextWord = ivec3(it.nextWord.x, it.first.y, it.nextWord.z + 1);
    }
    const int bit = findLSB(it.remaining);
    it.voxel.x = (it.voxel.x & ~31) + bit;
    it.number = voxelRank.before[it.wordIndex] + uint(bitCount(it.word & ((1u << bit) - 1u)));
    it.remaining &= it.remaining - 1u;
    return true;
}

// The box of voxels whose centers are within the search radius of a point along each axis, in voxels.
void boxWithinReach(vec3 center, out ivec3 first, out ivec3 last) {
    first = max(ivec3(ceil(center - 0.5 - push.searchRadius)), ivec3(0));
    last = min(ivec3(floor(center - 0.5 + push.searchRadius)), ivec3(push.grid.resolution) - 1);
}

// Squared SLIC distance (Achanta et al. 2012, equation 3) with normals instead of colors: positions in units of the
// search radius, normals in units of the chord of the angle limit. 0 to 4 within both.
float clusterDistance(vec3 center, ivec3 voxel, float cosine) {
    const vec3 offset = (vec3(voxel) + 0.5 - center) / push.searchRadius;
    return dot(offset, offset) + (1.0 - cosine) / (1.0 - push.minCosine);
}
