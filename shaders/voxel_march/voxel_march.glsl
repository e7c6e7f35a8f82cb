// Rays through voxels (docs/voxel-march.md): whether a surface voxel lies between two points, and the first surface
// voxel on a ray. Rays intersect voxels, not triangles, so any shader may trace them. The including shader is compiled
// with VoxelMarch::defines() and given VoxelMarch::bindings() (passes/common/voxel_march/voxel_march.h).
#ifndef VOXRAY_VOXEL_MARCH_GLSL
#define VOXRAY_VOXEL_MARCH_GLSL

#include "shaders/voxel_march/segment.glsl"
#include "shaders/voxel_march/surface_segment.glsl"
#include "shaders/voxels/voxels.glsl"

// Counts of this invocation: steps from one empty box to the next, and words of occupancy, bricks or nodes read.
uint marchSteps = 0u;
uint marchVisits = 0u;

// A traversal defines
//  - void initTraversal(VoxelGrid g, VoxelSegment s), called before the first step on a segment;
//  - bool advanceToOccupied(VoxelGrid g, VoxelSegment s, inout ivec3 flipped): advances from a voxel of the segment to
//    the first occupied one, which may be the voxel itself; false where there is none. Voxels are flipped
//    (VoxelSegment::flip). All traversals find the same.
#if defined(MARCH_BITS)
#include "shaders/voxel_march/traverse_bits.glsl"
#elif defined(MARCH_BRICKS)
#include "shaders/voxel_march/traverse_bricks.glsl"
#elif defined(MARCH_SVO_RESTART) || defined(MARCH_SVO_VOXELS)
#include "shaders/voxel_march/traverse_svo_restart.glsl"
#elif defined(MARCH_SVO)
#include "shaders/voxel_march/traverse_svo.glsl"
#endif

#ifndef MARCH_EPSILON
// The first occupied voxel on a segment; false where there is none.
bool firstOccupiedVoxel(VoxelGrid g, VoxelSegment s, out ivec3 voxel) {
    voxel = firstVoxel(s);
    initTraversal(g, s);
    const bool found = advanceToOccupied(g, s, voxel);
    voxel ^= s.flip;
    return found;
}

// Advances from a flipped voxel to the next one on a segment; false where the segment ends in it.
bool leaveVoxel(VoxelSegment s, inout ivec3 flipped) {
    ++marchSteps;
    ivec3 next = flipped;
    const int state = leaveBox(s, flipped + 1, next);
    if (state == MARCH_UNSURE) return leaveBoxExactly(s, flipped + 1, flipped);
    flipped = next;
    return state == MARCH_MOVED;
}
#endif

// Steps and visits of all invocations, 64 bits each, low words first.
layout(scalar) buffer VoxelMarchCounts { uint words[4]; } voxelMarchCounts;

void addCount(uint word, uint count) {
    if (count == 0u) return;
    const uint before = atomicAdd(voxelMarchCounts.words[word], count);
    if (before + count < before) atomicAdd(voxelMarchCounts.words[word + 1u], 1u);
}

// Adds this invocation's counts to those of all. Call it once, at the end.
void countMarch() {
    addCount(0u, marchSteps);
    addCount(2u, marchVisits);
}

// A point of a ray; exact along axes where the direction is 0, even for infinite t.
vec3 pointAt(vec3 origin, vec3 direction, float t) {
    precise const vec3 moved = origin + t * direction;
    return mix(moved, origin, equal(direction, vec3(0.0)));
}

// Clips the range [tMin, tMax] of a ray, in grid coordinates, to the grid; false where nothing is left.
bool clipToGrid(VoxelGrid g, vec3 origin, vec3 direction, inout float tMin, inout float tMax) {
    const vec3 size = vec3(g.resolution);
    for (int axis = 0; axis < 3; ++axis) {
        if (direction[axis] == 0.0) {
            if (!(origin[axis] >= 0.0 && origin[axis] < size[axis])) return false;
            continue;
        }
        precise const float low = (0.0 - origin[axis]) / direction[axis],
                            high = (size[axis] - origin[axis]) / direction[axis];
        tMin = max(tMin, min(low, high));
        tMax = min(tMax, max(low, high));
    }
    return tMin <= tMax;
}

// Whether an occupied voxel is on the segment from a to b (m), including both ends. Symmetric: ends within the grid are
// not rounded.
bool occluded(VoxelGrid g, vec3 a, vec3 b) {
    const vec3 from = gridCoordinates(g, a), to = gridCoordinates(g, b), offset = to - from;
    float tMin = 0.0, tMax = 1.0;
    if (!clipToGrid(g, from, offset, tMin, tMax)) return false;
    const VoxelSegment s = makeSegment(tMin > 0.0 ? pointAt(from, offset, tMin) : from,
                                       tMax < 1.0 ? pointAt(from, offset, tMax) : to, g.resolution);
    ivec3 voxel;
    return firstOccupiedVoxel(g, s, voxel);
}

// Whether voxels occlude two points of surfaces from each other, in front of both unit normals.
bool occludedBetweenSurfaces(VoxelGrid g, vec3 a, vec3 normalA, vec3 b, vec3 normalB) {
    vec3 from, to;
    return segmentBetweenSurfaces(g, a, normalA, b, normalB, from, to) && occluded(g, from, to);
}

#define NO_FACE 6u

struct VoxelHit {
    float t;      // Where the ray enters the voxel, in units of its direction; tMin if it starts in the voxel.
    ivec3 voxel;
    uint face;    // By which it enters, +x -x +y -y +z -z; NO_FACE if it starts in the voxel.
};

VoxelHit makeVoxelHit(VoxelSegment s, ivec3 voxel, float tMin, float tMax) {
    const ivec3 flipped = voxel ^ s.flip;
    if (flipped == firstVoxel(s)) return VoxelHit(tMin, voxel, NO_FACE);
    const vec3 entries = mix(planeParameters(s, unitsToPlanes(s, flipped)), vec3(-1.0), equal(s.run, vec3(0.0)));
    const int axis = entries.x >= entries.y && entries.x >= entries.z ? 0 : entries.y >= entries.z ? 1 : 2;
    return VoxelHit(tMin + entries[axis] * (tMax - tMin), voxel, uint(2 * axis + (s.flip[axis] == 0 ? 1 : 0)));
}

// Clips a ray (m) to the grid and makes its segment; false where the ray misses the grid. A ray with a direction of 0
// is a point.
bool segmentOfRay(VoxelGrid g, vec3 origin, vec3 direction, inout float tMin, inout float tMax, out VoxelSegment s) {
    const vec3 from = gridCoordinates(g, origin), gridDirection = direction / g.voxelSize;
    if (gridDirection == vec3(0.0)) tMax = tMin;
    if (!clipToGrid(g, from, gridDirection, tMin, tMax)) return false;
    s = makeSegment(pointAt(from, gridDirection, tMin), pointAt(from, gridDirection, tMax), g.resolution);
    return true;
}

// The first occupied voxel on a ray from `origin` (m) between tMin and tMax, which may be infinite; false where there
// is none.
bool closest(VoxelGrid g, vec3 origin, vec3 direction, float tMin, float tMax, out VoxelHit hit) {
    VoxelSegment s;
    ivec3 voxel;
    if (!segmentOfRay(g, origin, direction, tMin, tMax, s) || !firstOccupiedVoxel(g, s, voxel)) return false;
    hit = makeVoxelHit(s, voxel, tMin, tMax);
    return true;
}

#endif
