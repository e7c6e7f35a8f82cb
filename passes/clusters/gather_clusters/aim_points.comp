// Rays to the camera from the points round the voxels of a batch that it has not seen yet. A thread takes a point.
#include "passes/clusters/gather_clusters/seen_points.glsl"
#include "shaders/trace/ray_types.h"
layout(local_size_x = 64) in;

layout(scalar) writeonly buffer Rays { Ray data[]; } rays;

// Whether a point, from the camera on, lies in its image.
bool isInView(vec3 at) {
    const float depth = dot(at, push.forward);
    return depth > 0.0 && abs(dot(at, push.right)) <= depth * dot(push.right, push.right) &&
           abs(dot(at, push.up)) <= depth * dot(push.up, push.up);
}

void main() {
    const uint i = linearIndex();
    if (i >= push.voxels * POINTS) return;
    const uint voxel = push.firstVoxel + i / POINTS;
    const vec3 from = voxelCenter(push.grid, voxel) + 2.0 * push.grid.voxelSize * pointDirection(i % POINTS);
    const float away = distance(push.origin, from);
    const bool isAsked = asked.data[voxel] == 0u && away > 0.0 && isInView(from - push.origin);
    rays.data[i] = isAsked ? Ray(from, 0.0, (push.origin - from) / away, away) : kNoRay;
}
