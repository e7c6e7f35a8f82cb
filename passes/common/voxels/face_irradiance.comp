#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Flux over area: the irradiance of each voxel's faces, indirect with or without the direct one, and the area.
#include "shaders/compute/large_buffer.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer DirectAt { LargeFloats direct; };
layout(scalar) readonly buffer IndirectAt { LargeFloats indirect; };
layout(scalar) readonly buffer Area { float data[]; } area;
layout(scalar) writeonly buffer Faces { vec4 data[]; } faces;
layout(push_constant) uniform Push {
    uint count;           // Faces.
    float voxelFaceArea;  // m²
    float directShare;    // 1 or 0.
} push;

vec3 flux(uint at) {
    return push.directShare * vec3(direct.data[at], direct.data[at + 1u], direct.data[at + 2u]) +
           vec3(indirect.data[at], indirect.data[at + 1u], indirect.data[at + 2u]);
}

void main() {
    const uint face = linearIndex();
    if (face >= push.count) return;
    const float a = area.data[face];
    faces.data[face] = a > 0.0 ? vec4(flux(3u * face) / (a * push.voxelFaceArea), a) : vec4(0.0);
}
