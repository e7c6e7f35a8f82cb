// Points for the test whether a light sees a voxel: 18 points, 1.5 voxels from its center (Cosin and Patow 2022, 4.4).
#include "passes/clusters/voxel_points.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/lights/lights.glsl"

#define POINTS EDGE_AND_FACE_POINTS

layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint firstVoxel;
    uint voxels;
    uint light;
    uint pointSeed;
} push;
