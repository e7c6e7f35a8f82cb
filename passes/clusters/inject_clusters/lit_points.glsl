// 18 points around voxels that a light may see, 1.5 voxels from their centers (Cosin and Patow 2022, section 4.4).
#include "passes/clusters/voxel_points.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/lights/lights.glsl"

#define POINTS EDGE_AND_FACE_POINTS

layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint firstVoxel;
    uint voxels;
    uint light;
} push;
