#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Picks the surfels whose voxel faces are asked for. Their order is any; nothing depends on it.
#include "shaders/linear_index.glsl"
#include "shaders/shared/surfel_types.h"
layout(local_size_x = 64) in;

layout(set = 0, binding = 16, scalar) readonly buffer Surfels { Surfel data[]; } surfels;
layout(set = 0, binding = 17) readonly buffer Asked { uint data[]; } asked;  // A bit a face, by voxel.
layout(set = 0, binding = 18, scalar) writeonly buffer Selected { Surfel data[]; } selected;
layout(set = 0, binding = 19) buffer Count { uint value; } count;
layout(push_constant) uniform Push { uint count; } push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const uint bits = asked.data[surfels.data[i].voxel];
    if (bits == 0u) return;
    const vec3 normal = surfels.data[i].normal;
    uint faces = 0u;
    for (uint axis = 0u; axis < 3u; ++axis)
        if (normal[axis] * normal[axis] > 0.01) faces |= 1u << (2u * axis + (normal[axis] < 0.0 ? 1u : 0u));
    if ((bits & faces) != 0u) selected.data[atomicAdd(count.value, 1u)] = surfels.data[i];
}
