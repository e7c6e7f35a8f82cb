// Points round voxels that the camera looks for, 2 voxels from their centers (Cosin and Patow 2022, section 4.4): 12, for which we take
// those beyond the edges.
#include "passes/clusters/voxel_points.glsl"
#include "shaders/compute/linear_index.glsl"

#define POINTS EDGE_POINTS

buffer Asked { uint data[]; } asked;  // By voxel: it was seen.
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint firstVoxel;
    uint voxels;
    vec3 origin;  // The camera.
    vec3 forward;
    vec3 right;  // From the image's center to its edge, at a distance of 1.
    vec3 up;
} push;
