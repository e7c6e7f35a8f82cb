#version 460
#extension GL_GOOGLE_include_directive : require
// Adds probe points to the counts of their voxels, nine each: visible points by face +x -x +y -y +z -z, then all points by axis. A
// point on a surface with unit normal n counts n_a² along axis a, in fixed point; 16 bits leave room for 65536 points.
#include "shaders/compute/linear_index.glsl"
#include "shaders/trace/ray_types.h"
#include "shaders/voxels/face.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Rays { Ray data[]; } rays;
readonly buffer Occluded { uint data[]; } occluded;
buffer Counts { uint data[]; } counts;
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint points;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.points) return;
    const Ray front = rays.data[2u * i];
    const bool frontVisible = occluded.data[2u * i] == 0u, backVisible = occluded.data[2u * i + 1u] == 0u;
    const uint voxel = voxelNumber(push.grid, voxelAt(push.grid, front.origin));
    if (voxel == NO_VOXEL) return;
    const uint first = 9u * voxel;
    for (uint axis = 0u; axis < 3u; ++axis) {
        const uint weight = uint(round(front.direction[axis] * front.direction[axis] * 65536.0));
        if (weight == 0u) continue;
        atomicAdd(counts.data[first + 6u + axis], weight);
        // The front side turns to the face that the normal points to, the back side to the opposite one.
        const uint face = faceOf(front.direction, axis);
        if (frontVisible) atomicAdd(counts.data[first + face], weight);
        if (backVisible) atomicAdd(counts.data[first + (face ^ 1u)], weight);
    }
}
