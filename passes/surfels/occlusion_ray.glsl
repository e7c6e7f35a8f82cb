// Whether open space lies before a side of a surface, as far as a voxel: an open side, else a covered one.
#ifndef VOXRAY_OPEN_SPACE_GLSL
#define VOXRAY_OPEN_SPACE_GLSL

#include "shaders/scene/sampling.glsl"
#include "shaders/trace/ray_types.h"

// `position`: off the surface, where rays may begin. The ray whose occlusion tells it. normal: geometric, unit length, on that side; voxelSize in m.
Ray occlusionRay(vec3 position, vec3 normal, float voxelSize) {
    return Ray(position, 0.0, normal, voxelSize);
}

#endif
