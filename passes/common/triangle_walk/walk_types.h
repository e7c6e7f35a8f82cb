// What a walk over triangles and voxels is told: shared by C++ (triangle_walk.h) and GLSL.
#ifndef VOXRAY_TRIANGLE_WALK_TYPES_H
#define VOXRAY_TRIANGLE_WALK_TYPES_H

#include "shaders/voxels/voxel_types.h"

VOXRAY_SHARED_BEGIN

struct TriangleWalkPush {
    VoxelGrid grid;
    float visitorScale;  // The visitor's own: the unit of its fixed-point numbers, or the like.
    uint tiles;          // exact: number of tiles.
    uint axis;           // three_axis: that this pass looks along.
    uint samples;        // three_axis: sample points along a voxel's edge; sampled_axis: a pixel, 1 or 8.
    uint imageSide;      // dominant_axis, sampled_axis: pixels along the side of the image.
};

VOXRAY_SHARED_END

#endif
