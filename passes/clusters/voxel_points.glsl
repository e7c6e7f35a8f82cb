// Sample points around voxels, in the directions of their 12 edges and 6 faces (Cosin and Patow 2022, section 4.4).
#ifndef VOXRAY_VOXEL_POINTS_GLSL
#define VOXRAY_VOXEL_POINTS_GLSL

#include "shaders/voxels/voxels.glsl"

#define EDGE_POINTS 12u
#define EDGE_AND_FACE_POINTS 18u

layout(scalar) readonly buffer Coordinates { uvec3 data[]; } coordinates;  // Per voxel.

// m
vec3 voxelCenter(VoxelGrid grid, uint voxel) {
    return grid.origin + grid.voxelSize * (vec3(coordinates.data[voxel]) + 0.5);
}

// Unit length. Points 0 to 11 lie beyond edges, four along each axis; points 12 to 17 beyond faces.
vec3 pointDirection(uint i) {
    vec3 direction = vec3(0.0);
    if (i >= EDGE_POINTS) {
        const uint face = i - EDGE_POINTS;
        direction[face / 2u] = face % 2u == 0u ? 1.0 : -1.0;
        return direction;
    }
    const uint axis = i / 4u;
    direction[(axis + 1u) % 3u] = (i & 1u) == 0u ? 1.0 : -1.0;
    direction[(axis + 2u) % 3u] = (i & 2u) == 0u ? 1.0 : -1.0;
    return normalize(direction);
}

#endif
