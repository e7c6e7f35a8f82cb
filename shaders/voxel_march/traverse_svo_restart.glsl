// Traverses the octree with a descent from the root in each step, to the largest empty node around the current voxel
// (Sun and Agu 2015, figure 3). With MARCH_SVO_VOXELS a step goes to the next voxel, however large the empty node is
// (Seok 2021, figure 12).
#include "shaders/octree/octree.glsl"

ivec3 segmentFlip;

void initTraversal(VoxelGrid g, VoxelSegment s) { segmentFlip = s.flip; }

// The largest empty node around a voxel: its width in voxels, minus 1; -1 where the voxel is occupied.
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
// Steps in floats as in the paper: past a node by MARCH_EPSILON voxels. Shorter segments in a voxel, at its corners,
// are skipped.
bool firstOccupiedVoxel(VoxelGrid g, VoxelSegment s, out ivec3 voxel) {
    const vec3 from = (vec3(s.start) + 0.5) / float(MARCH_UNITS), offset = s.run / float(MARCH_UNITS);
    const float end = length(offset);
    const vec3 direction = end > 0.0 ? offset / end : vec3(0.0);
    const uint bound = 4u * voxelsBetween(s) + 4u;
    float t = 0.0;
    for (uint i = 0u; i <= bound; ++i) {
        const ivec3 flipped = min(ivec3(from + t * direction), s.last);
        voxel = flipped ^ s.flip;
        const int cube = emptyCube(voxel);
        if (cube < 0) return true;
        const vec3 planes = vec3((flipped | cube) + 1);
        float tExit = end;
        for (int axis = 0; axis < 3; ++axis)
            if (direction[axis] > 0.0) tExit = min(tExit, (planes[axis] - from[axis]) / direction[axis]);
        t = max(tExit, t) + MARCH_EPSILON;
        if (t >= end) return false;
        ++marchSteps;
    }
    return false;
}
#else
bool findEmptyBox(ivec3 flipped, out ivec3 planes) {
    const int cube = emptyCube(flipped ^ segmentFlip);
#ifdef MARCH_SVO_VOXELS
    planes = flipped + 1;
#else
    planes = (flipped | cube) + 1;
#endif
    return cube >= 0;
}

#include "shaders/voxel_march/traverse_boxes.glsl"
#endif
