// Rays from the points around voxels and their occlusion (passes/clusters/voxel_point_rays.h).
#ifndef VOXRAY_VOXEL_POINT_RAYS_GLSL
#define VOXRAY_VOXEL_POINT_RAYS_GLSL

#include "shaders/trace/ray_types.h"

layout(scalar) readonly buffer Rays { Ray data[]; } rays;
readonly buffer Occluded { uint data[]; } occluded;

// Whether any of the rays is active and unoccluded. The tracer reports inactive rays (tMax < 0) as unoccluded.
bool anyUnoccluded(uint first, uint count) {
    for (uint i = first; i < first + count; ++i)
        if (rays.data[i].tMax >= 0.0 && occluded.data[i] == 0u) return true;
    return false;
}

#endif
