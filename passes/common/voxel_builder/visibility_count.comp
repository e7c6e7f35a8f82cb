#version 460
#extension GL_GOOGLE_include_directive : require
// Adds each point to its voxel: to all points by axis and, for each side with nothing before it, to the exposed ones by the
// direction that the side faces. Weights are squared normal components in fixed point; 16 bits leave room for 65536 points.
#include "shaders/compute/linear_index.glsl"
#include "shaders/trace/ray_types.h"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(set = 0, binding = 16, scalar) readonly buffer Rays { Ray data[]; } rays;
layout(set = 0, binding = 17) readonly buffer Occluded { uint data[]; } occluded;
layout(set = 0, binding = 18) buffer Counts { uint data[]; } counts;
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint points;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.points) return;
    const uint voxel = voxelNumber(push.grid, voxelAt(push.grid, rays.data[2u * i].origin));
    if (voxel == NO_VOXEL) return;
    for (uint axis = 0u; axis < 3u; ++axis) {
        const float component = rays.data[2u * i].direction[axis];
        const uint weight = uint(round(component * component * 65536.0));
        if (weight == 0u) continue;
        atomicAdd(counts.data[voxel * 9u + 6u + axis], weight);
        // The front side faces as the normal does, the back side the other way.
        const uint front = component < 0.0 ? 1u : 0u;
        if (occluded.data[2u * i] == 0u) atomicAdd(counts.data[voxel * 9u + 2u * axis + front], weight);
        if (occluded.data[2u * i + 1u] == 0u) atomicAdd(counts.data[voxel * 9u + 2u * axis + 1u - front], weight);
    }
}
