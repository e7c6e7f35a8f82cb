// Where rays through voxels start at surfaces, shared by C++ (passes/common/voxel_march/) and GLSL
// (shaders/voxel_march/voxel_march.glsl).
#ifndef VOXRAY_SHARED_SURFACE_OFFSET_H
#define VOXRAY_SHARED_SURFACE_OFFSET_H

// How far along its normal a point is from a plane when no voxel that the plane touches holds it, in voxels: the diagonal
// of a voxel.
#define VOXELS_OFF_SURFACE 1.7320508f

#endif
