// The ray that tells whether a surface is occluded: whether another one lies less than a voxel before it.
#ifndef VOXRAY_OCCLUSION_RAY_GLSL
#define VOXRAY_OCCLUSION_RAY_GLSL

#include "shaders/trace/ray_types.h"

// `position`: off the surface, where rays may begin. `normal`: geometric, unit length. `voxelSize`: m.
Ray occlusionRay(vec3 position, vec3 normal, float voxelSize) { return Ray(position, 0.0, normal, voxelSize); }

#endif
