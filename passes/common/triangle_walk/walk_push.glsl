// The push constants of a walk's shaders: `walk`.
#ifndef VOXRAY_WALK_PUSH_GLSL
#define VOXRAY_WALK_PUSH_GLSL

#include "shaders/voxels/voxel_types.h"

layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    float visitorScale;  // The visitor's own: the unit of its fixed-point numbers, or the like.
    uint tiles;          // exact: number of tiles.
    uint axis;           // three_axis: that this pass looks along.
    uint samples;        // three_axis: sample points along a voxel's edge; sampled_axis: a pixel, 1 or 8.
    uint imageSide;      // dominant_axis, sampled_axis: pixels along the side of the image.
} walk;

#endif
