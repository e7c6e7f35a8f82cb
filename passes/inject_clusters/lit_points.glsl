// Points round voxels from which a light is looked for: beyond the centers of their 6 faces and 12 edges, 1.5 voxels from their center
// (Cosin and Patow 2022, section 4.4).
#extension GL_EXT_scalar_block_layout : require
#include "shaders/compute/linear_index.glsl"
#include "shaders/lights/lights.glsl"
#include "shaders/trace/ray_types.h"
#include "shaders/voxels/voxels.glsl"

#define POINTS 18u

layout(scalar) readonly buffer Coordinates { uvec3 data[]; } coordinates;  // Of voxels.
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint firstVoxel;
    uint voxels;
    uint light;
} push;

// m
vec3 voxelCenter(uint voxel) { return push.grid.origin + push.grid.voxelSize * (vec3(coordinates.data[voxel]) + 0.5); }

// Unit length. 0 to 5: faces. 6 to 17: edges, four along each axis.
vec3 pointDirection(uint i) {
    vec3 direction = vec3(0.0);
    if (i < 6u) {
        direction[i / 2u] = i % 2u == 0u ? 1.0 : -1.0;
        return direction;
    }
    const uint axis = (i - 6u) / 4u, corner = i - 6u;
    direction[(axis + 1u) % 3u] = (corner & 1u) == 0u ? 1.0 : -1.0;
    direction[(axis + 2u) % 3u] = (corner & 2u) == 0u ? 1.0 : -1.0;
    return normalize(direction);
}
