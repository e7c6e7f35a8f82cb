// The occupied voxels of a box, row by row, and what a voxel's distance from a cluster is.
#include "passes/clusters/cluster_types.h"
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxels/voxels.glsl"

layout(scalar) readonly buffer Normals { vec3 data[]; } normals;  // By voxel number, unit.
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint count;       // Of threads that have work.
    float reach;      // Voxels: how far from a cluster's center its voxels lie at most, along each axis.
    float minCosine;  // Of the largest angle between a cluster's normal and those of its voxels.
    uint first;       // 1: the first cluster to ask for a voxel has it. 0: the nearest.
    uint firstOwn;    // Number of the cluster that grows from voxel 0, after those that grow from seeds.
} push;

// The occupied voxels of a box one after another, a word of 32 neighbours at a time: for (BoxWalk w = walkBox(...); nextVoxel(w);).
struct BoxWalk {
    ivec3 first, last;  // Of the box, both included.
    ivec3 word;         // The next one: its number in the row, and the row.
    uint at, all;       // The word in hand, and the bits of it.
    uint bits;          // Those in the box that are still to come.
    ivec3 voxel;
    uint number;
};

BoxWalk walkBox(ivec3 first, ivec3 last) {
    BoxWalk w;
    w.first = first;
    w.last = last;
    w.word = ivec3(first.x >> 5, first.yz);
    w.bits = 0u;
    return w;
}

bool nextVoxel(inout BoxWalk w) {
    if (any(greaterThan(w.first, w.last))) return false;
    while (w.bits == 0u) {
        if (w.word.z > w.last.z) return false;
        const int low = max(w.first.x - 32 * w.word.x, 0), high = min(w.last.x - 32 * w.word.x, 31);
        w.at = uint(w.word.z * int(push.grid.resolution.y) + w.word.y) * push.grid.wordsPerRow + uint(w.word.x);
        w.all = voxelOccupancy.words[w.at];
        w.bits = w.all & (0xffffffffu << low) & (0xffffffffu >> (31 - high));
        w.voxel = ivec3(32 * w.word.x, w.word.yz);
        if (++w.word.x > w.last.x >> 5) w.word = ivec3(w.first.x >> 5, w.word.y + 1, w.word.z);
        if (w.word.y > w.last.y) w.word = ivec3(w.word.x, w.first.y, w.word.z + 1);
    }
    const int bit = findLSB(w.bits);
    w.voxel.x = (w.voxel.x & ~31) + bit;
    w.number = voxelRank.before[w.at] + uint(bitCount(w.all & ((1u << bit) - 1u)));
    w.bits &= w.bits - 1u;
    return true;
}

// The box of voxels whose centers are within reach of a point (in voxels).
void boxWithinReach(vec3 center, out ivec3 first, out ivec3 last) {
    first = max(ivec3(ceil(center - 0.5 - push.reach)), ivec3(0));
    last = min(ivec3(floor(center - 0.5 + push.reach)), ivec3(push.grid.resolution) - 1);
}

// Squared distance, from 0 to 4 within reach: places in units of the reach, normals in units of the chord of the angle limit (SLIC,
// Achanta et al. 2012, equation 3, with normals for colors).
float clusterDistance(vec3 center, ivec3 voxel, float cosine) {
    const vec3 away = (vec3(voxel) + 0.5 - center) / push.reach;
    return dot(away, away) + (1.0 - cosine) / (1.0 - push.minCosine);
}
