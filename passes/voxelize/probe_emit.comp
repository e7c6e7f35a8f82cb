#version 460
#extension GL_GOOGLE_include_directive : require
// For each point on a surface a ray along its normal and one against it, as long as a voxel.
#include "shaders/linear_index.glsl"
#include "shaders/sampling.glsl"
#include "shaders/scene.glsl"
#include "shaders/shared/ray_types.h"
#include "shaders/shared/voxel_types.h"
layout(local_size_x = 64) in;

layout(set = 0, binding = 16) readonly buffer PointTriangles { uint data[]; } pointTriangles;
layout(set = 0, binding = 17, scalar) writeonly buffer Rays { Ray data[]; } rays;
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint firstPoint;
    uint points;
    uint seed;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.points) return;
    const SurfacePoint s = surfacePoint(pointTriangles.data[i], trianglePoint(sobol2(push.firstPoint + i, push.seed)));
    const float offset = surfaceOffset(s.position);
    for (uint side = 0u; side < 2u; ++side) {
        const vec3 normal = side == 0u ? s.geometricNormal : -s.geometricNormal;
        Ray ray;
        ray.origin = s.position + normal * offset;
        ray.direction = normal;
        ray.tMin = 0.0;
        ray.tMax = dot(normal, normal) > 0.0 ? push.grid.voxelSize : -1.0;
        rays.data[2u * i + side] = ray;
    }
}
