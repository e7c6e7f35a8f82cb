#version 460
#extension GL_EXT_scalar_block_layout : require
// Adds what the shadow rays carry where nothing was in their way.
layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0, scalar) readonly buffer Carried { vec4 data[]; } carried;
layout(set = 0, binding = 1, scalar) readonly buffer Occluded { uint data[]; } occluded;
layout(set = 0, binding = 2, rgba32f) uniform image2D direct;
layout(push_constant) uniform Push {
    uint width;
    uint height;
} push;

void main() {
    const uvec2 pixel = gl_GlobalInvocationID.xy;
    if (pixel.x >= push.width || pixel.y >= push.height) return;
    const uint index = pixel.y * push.width + pixel.x;
    if (occluded.data[index] != 0u) return;
    const vec4 sum = imageLoad(direct, ivec2(pixel)) + vec4(carried.data[index].rgb, 0.0);
    imageStore(direct, ivec2(pixel), sum);
}
