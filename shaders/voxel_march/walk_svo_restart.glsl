// Through the octree, from the root down in each step: to the empty node around the walk's place, and out of it (Sun and Agu 2015,
// figure 3); or, with MARCH_WALK_SVO_VOXELS, to the next voxel, however large the empty node is (Seok 2021, figure 12).
#include "shaders/octree/octree.glsl"

ivec3 walkFlip;

void beginWalk(VoxelGrid g, VoxelSegment s) { walkFlip = s.flip; }

// The width less 1 of the largest empty node around a voxel; -1 where the voxel is occupied.
int emptyCube(ivec3 voxel) {
    uint node = 1u;
    for (int level = int(octree.shape.levels) - 1; level > 0; --level) {
        ++marchVisits;
        node = octreeChild(octree.nodes.data[node], octantOf(voxel >> (level - 1)));
        if (node == NO_NODE) return (1 << (level - 1)) - 1;
    }
    return -1;
}

#ifdef MARCH_EPSILON
// The paper's steps in floats: past a node by MARCH_EPSILON voxels. What is thinner than that on the way, a corner of a voxel, is
// skipped.
bool walkVoxels(VoxelGrid g, VoxelSegment s, out ivec3 voxel) {
    const vec3 from = (vec3(s.start) + 0.5) / float(MARCH_UNITS), way = s.run / float(MARCH_UNITS);
    const float end = length(way);
    const vec3 direction = end > 0.0 ? way / end : vec3(0.0);
    const uint bound = 4u * voxelsBetween(s) + 4u;
    float t = 0.0;
    for (uint i = 0u; i <= bound; ++i) {
        const ivec3 at = min(ivec3(from + t * direction), s.last);
        voxel = at ^ s.flip;
        const int cube = emptyCube(voxel);
        if (cube < 0) return true;
        const vec3 planes = vec3((at | cube) + 1);
        float leaves = end;
        for (int axis = 0; axis < 3; ++axis)
            if (direction[axis] > 0.0) leaves = min(leaves, (planes[axis] - from[axis]) / direction[axis]);
        t = max(leaves, t) + MARCH_EPSILON;
        if (t >= end) return false;
        ++marchSteps;
    }
    return false;
}
#else
bool emptyBox(ivec3 at, out ivec3 planes) {
    const int cube = emptyCube(at ^ walkFlip);
#ifdef MARCH_WALK_SVO_VOXELS
    planes = at + 1;
#else
    planes = (at | cube) + 1;
#endif
    return cube >= 0;
}

#include "shaders/voxel_march/walk_boxes.glsl"
#endif
