// Generates shadow rays from the points around a batch of voxels to a punctual light.
#include "passes/clusters/inject_clusters/lit_points.glsl"
#include "shaders/trace/ray_types.h"
layout(local_size_x = 64) in;

layout(scalar) writeonly buffer Rays { Ray data[]; } rays;

void main() {
    const uint i = linearIndex();
    if (i >= push.voxels * POINTS) return;
    const vec3 center = voxelCenter(push.grid, push.firstVoxel + i / POINTS);
    const vec3 point = center + 1.5 * push.grid.voxelSize * pointDirection(i % POINTS);
    const LightSample l = samplePunctual(sceneLights.data[push.light], point);
    // Inactive outside of a spot's cone
    rays.data[i] = any(greaterThan(l.irradiance, vec3(0.0))) ? Ray(point, 0.0, l.direction, l.distance_) : kNoRay;
}
