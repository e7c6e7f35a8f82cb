// Generates rays to the camera from the points around each voxel of a batch. Rays are inactive if the voxel was
// requested before or if the point is outside of the image.
#include "passes/clusters/gather_clusters/visible_points.glsl"
#include "shaders/trace/ray_types.h"
layout(local_size_x = 64) in;

layout(scalar) writeonly buffer Rays { Ray data[]; } rays;

// @param p relative to the camera.
bool isInImage(vec3 p) {
    const float depth = dot(p, push.forward);
    return depth > 0.0 && abs(dot(p, push.right)) <= depth * dot(push.right, push.right) &&
           abs(dot(p, push.up)) <= depth * dot(push.up, push.up);
}

void main() {
    const uint i = linearIndex();
    if (i >= push.voxels * POINTS) return;
    const uint voxel = push.firstVoxel + i / POINTS;
    const vec3 point = voxelCenter(push.grid, voxel) + 2.0 * push.grid.voxelSize * pointDirection(i % POINTS);
    const float distance_ = distance(push.origin, point);
    const bool isNeeded = requestedVoxels.data[voxel] == 0u && distance_ > 0.0 && isInImage(point - push.origin);
    rays.data[i] = isNeeded ? Ray(point, 0.0, (push.origin - point) / distance_, distance_) : kNoRay;
}
