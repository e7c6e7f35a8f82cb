// Points for the test whether the camera sees a voxel: 12 points, 2 voxels from its center (Cosin and Patow 2022,
// section 4.4; the paper does not say which, here those beyond the edges).
#include "passes/clusters/voxel_points.glsl"
#include "shaders/compute/linear_index.glsl"

#define POINTS EDGE_POINTS

buffer RequestedVoxels { uint data[]; } requestedVoxels;  // Per voxel: 1 if it was visible before.
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint firstVoxel;
    uint voxels;
    vec3 origin;  // Position of the camera.
    vec3 forward;
    vec3 right;  // From the image's center to its edge, at a distance of 1.
    vec3 up;
} push;
