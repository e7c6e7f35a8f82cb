// Push constants of all voxelizer shaders: `voxelizer`.
#ifndef VOXRAY_VOXELIZER_PUSH_GLSL
#define VOXRAY_VOXELIZER_PUSH_GLSL

#include "shaders/voxels/voxel_types.h"

layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    float fixedPointScale;  // For the fragment callback: units of its fixed-point sums, or the like.
    uint tiles;             // exact: number of tiles.
    uint axis;              // three_axis: axis of projection.
    uint samples;           // three_axis: sample points along a voxel's edge; others: per pixel.
    uint imageSide;         // dominant_axis.geom: pixels along an edge of the image.
} voxelizer;

#endif
