#version 460
#extension GL_GOOGLE_include_directive : require
// Fills the emission target with the environment's radiance; surfaces are drawn over it.
#include "shaders/scene.glsl"
layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 16, rgba32f) writeonly uniform image2D background;
layout(push_constant, scalar) uniform Push {
    vec3 forward;
    uint width;
    vec3 right;
    uint height;
    vec3 up;
    float padding;
} push;

void main() {
    const uvec2 pixel = gl_GlobalInvocationID.xy;
    if (pixel.x >= push.width || pixel.y >= push.height) return;
    const vec2 ndc = 2.0 * (vec2(pixel) + 0.5) / vec2(push.width, push.height) - 1.0;
    const vec3 d = normalize(push.forward + ndc.x * push.right - ndc.y * push.up);
    imageStore(background, ivec2(pixel), vec4(environmentRadiance(d), 0.0));
}
