// 12 points around voxels that the camera may see, 2 voxels from their centers (Cosin and Patow 2022, section 4.4; the paper does not
// say which, here those beyond the edges).
#include "passes/clusters/voxel_points.glsl"
#include "shaders/compute/linear_index.glsl"

#define POINTS EDGE_POINTS

buffer RequestedVoxels { uint data[]; } requestedVoxels;  // By voxel: 1 if the camera has seen it.
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint firstVoxel;
    uint voxels;
    vec3 origin;  // The camera.
    vec3 forward;
    vec3 right;  // From the image's center to its edge, at a distance of 1.
    vec3 up;
} push;
