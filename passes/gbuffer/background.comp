#version 460
#extension GL_EXT_scalar_block_layout : require
// Fills the emission target with the environment's radiance; surfaces are drawn over it.
layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform sampler2D environment;
layout(set = 0, binding = 1, rgba32f) writeonly uniform image2D emission;
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
    const float pi = 3.14159265358979;
    const vec2 uv = vec2(0.5 + atan(d.x, -d.z) / (2.0 * pi), acos(clamp(d.y, -1.0, 1.0)) / pi);
    imageStore(emission, ivec2(pixel), vec4(textureLod(environment, uv, 0.0).rgb, 0.0));
}
