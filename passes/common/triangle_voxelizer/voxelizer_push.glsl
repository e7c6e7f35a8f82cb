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
} voxelizer;

#ifdef LEVELS
// The grids into which one draw rasterizes (level_voxelizer.h).
layout(scalar) readonly buffer LevelGrids { VoxelGrid data[]; } levelGrids;
#define DRAWN_GRID(level) levelGrids.data[level]
#else
#define DRAWN_GRID(level) voxelizer.grid
#endif

#endif
