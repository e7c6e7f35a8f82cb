// What rays from the points round voxels found (passes/clusters/point_rays.h).
#ifndef VOXRAY_POINT_RAYS_GLSL
#define VOXRAY_POINT_RAYS_GLSL

#include "shaders/trace/ray_types.h"

layout(scalar) readonly buffer Rays { Ray data[]; } rays;
readonly buffer Occluded { uint data[]; } occluded;

// Whether one of so many rays from `first` on arrives. An inactive ray is not occluded either.
bool arrives(uint first, uint count) {
    for (uint i = first; i < first + count; ++i)
        if (rays.data[i].tMax >= 0.0 && occluded.data[i] == 0u) return true;
    return false;
}

#endif
