// Rays through voxels (docs/voxel-march.md): whether a surface voxel lies between two points, and the first one on a ray. Rays meet
// voxels, not triangles: a walk through our own data, so any shader may call it. The including shader is compiled with
// VoxelMarch::defines() and given VoxelMarch::bindings() (passes/common/voxel_march/voxel_march.h).
#ifndef VOXRAY_VOXEL_MARCH_GLSL
#define VOXRAY_VOXEL_MARCH_GLSL

#include "shaders/voxel_march/segment.glsl"
#include "shaders/voxel_march/surface_segment.glsl"
#include "shaders/voxels/voxels.glsl"

// What the walks of this thread took: moves from one empty cube to the next, and words of occupancy, bricks or nodes read.
uint marchSteps = 0u;
uint marchVisits = 0u;

// A walk declares
//  - void beginWalk(VoxelGrid g, VoxelSegment s), before the first step on a segment;
//  - bool walkOn(VoxelGrid g, VoxelSegment s, inout ivec3 at): from voxel `at` of the segment, counted as the segment sees voxels, to
//    the first occupied one, which may be `at` itself; false where there is none. All walks find the same one.
#if defined(MARCH_WALK_BITS)
#include "shaders/voxel_march/walk_bits.glsl"
#elif defined(MARCH_WALK_BRICKS)
#include "shaders/voxel_march/walk_bricks.glsl"
#elif defined(MARCH_WALK_SVO_RESTART) || defined(MARCH_WALK_SVO_VOXELS)
#include "shaders/voxel_march/walk_svo_restart.glsl"
#elif defined(MARCH_WALK_SVO)
#include "shaders/voxel_march/walk_svo.glsl"
#endif

#ifndef MARCH_EPSILON
// The first occupied voxel on a segment; false where there is none.
bool walkVoxels(VoxelGrid g, VoxelSegment s, out ivec3 voxel) {
    voxel = firstVoxel(s);
    beginWalk(g, s);
    const bool found = walkOn(g, s, voxel);
    voxel ^= s.flip;
    return found;
}

// From a voxel to the next one on a segment, as the segment sees them; false where the segment ends in it.
bool leaveVoxel(VoxelSegment s, inout ivec3 at) {
    ++marchSteps;
    ivec3 next = at;
    const int state = leaveBox(s, at + 1, next);
    if (state == MARCH_UNSURE) return leaveBoxExactly(s, at + 1, at);
    at = next;
    return state == MARCH_MOVED;
}
#endif

// Steps and visits of all threads, 64 bits each, low words first.
layout(scalar) buffer VoxelMarchCounts { uint words[4]; } voxelMarchCounts;

void addCount(uint word, uint count) {
    if (count == 0u) return;
    const uint before = atomicAdd(voxelMarchCounts.words[word], count);
    if (before + count < before) atomicAdd(voxelMarchCounts.words[word + 1u], 1u);
}

// Adds what this thread's walks took to the counts of all: once, at its end.
void countMarch() {
    addCount(0u, marchSteps);
    addCount(2u, marchVisits);
}

// A point of a ray. A direction of 0 along an axis stays there, however far.
vec3 pointAt(vec3 origin, vec3 direction, float t) {
    precise const vec3 moved = origin + t * direction;
    return mix(moved, origin, equal(direction, vec3(0.0)));
}

// Cuts the part [from, to] of a ray in voxels to what is in the grid; false where nothing is.
bool clipToGrid(VoxelGrid g, vec3 origin, vec3 direction, inout float from, inout float to) {
    const vec3 size = vec3(g.resolution);
    for (int axis = 0; axis < 3; ++axis) {
        if (direction[axis] == 0.0) {
            if (!(origin[axis] >= 0.0 && origin[axis] < size[axis])) return false;
            continue;
        }
        precise const float low = (0.0 - origin[axis]) / direction[axis], high = (size[axis] - origin[axis]) / direction[axis];
        from = max(from, min(low, high));
        to = min(to, max(low, high));
    }
    return from <= to;
}

// Whether an occupied voxel lies on the way from a to b (m), both ends included.
bool occluded(VoxelGrid g, vec3 a, vec3 b) {
    const vec3 from = gridCoordinates(g, a), to = gridCoordinates(g, b), way = to - from;
    float begin = 0.0, end = 1.0;
    if (!clipToGrid(g, from, way, begin, end)) return false;
    // Ends within the grid stay as they are: from b to a the answer is the same.
    const VoxelSegment s = makeSegment(begin > 0.0 ? pointAt(from, way, begin) : from,
                                       end < 1.0 ? pointAt(from, way, end) : to, g.resolution);
    ivec3 voxel;
    return walkVoxels(g, s, voxel);
}

// Whether voxels hide two points of surfaces from each other, on the sides that their unit normals point to.
bool occludedBetweenSurfaces(VoxelGrid g, vec3 a, vec3 normalA, vec3 b, vec3 normalB) {
    vec3 from, to;
    return segmentBetweenSurfaces(g, a, normalA, b, normalB, from, to) && occluded(g, from, to);
}

#define NO_FACE 6u

struct VoxelHit {
    float t;      // Where the ray enters the voxel, in multiples of its direction; tMin where it begins there.
    ivec3 voxel;
    uint face;    // Through which face, +x -x +y -y +z -z; NO_FACE where it begins there.
};

VoxelHit makeVoxelHit(VoxelSegment s, ivec3 voxel, float begin, float end) {
    const ivec3 at = voxel ^ s.flip;
    if (at == firstVoxel(s)) return VoxelHit(begin, voxel, NO_FACE);
    const vec3 parts = mix(partsTo(s, unitsTo(s, at)), vec3(-1.0), equal(s.run, vec3(0.0)));
    const int axis = parts.x >= parts.y && parts.x >= parts.z ? 0 : parts.y >= parts.z ? 1 : 2;
    return VoxelHit(begin + parts[axis] * (end - begin), voxel, uint(2 * axis + (s.flip[axis] == 0 ? 1 : 0)));
}

// The part of a ray in the grid, and the segment that it is there; false where the ray passes the grid. A ray without a direction is
// a point.
bool segmentOfRay(VoxelGrid g, vec3 origin, vec3 direction, inout float tMin, inout float tMax, out VoxelSegment s) {
    const vec3 from = gridCoordinates(g, origin), way = direction / g.voxelSize;
    if (way == vec3(0.0)) tMax = tMin;
    if (!clipToGrid(g, from, way, tMin, tMax)) return false;
    s = makeSegment(pointAt(from, way, tMin), pointAt(from, way, tMax), g.resolution);
    return true;
}

// The first occupied voxel on a ray from `origin` (m) between tMin and tMax, which may be infinite; false where there is none.
bool closest(VoxelGrid g, vec3 origin, vec3 direction, float tMin, float tMax, out VoxelHit hit) {
    VoxelSegment s;
    ivec3 voxel;
    if (!segmentOfRay(g, origin, direction, tMin, tMax, s) || !walkVoxels(g, s, voxel)) return false;
    hit = makeVoxelHit(s, voxel, tMin, tMax);
    return true;
}

#endif
