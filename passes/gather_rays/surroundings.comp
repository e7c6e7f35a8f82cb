#version 460
// Harmonic mean distance of what surrounds each texel, from its own rays and those of the texels within `radius`: few rays
// each are too noisy a guide. Rays that miss count as infinitely far.
layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 16) uniform sampler2D nearness;  // Sum of 1 / distance, number of rays.
layout(set = 0, binding = 17, r32f) writeonly uniform image2D surroundings;
layout(push_constant) uniform Push { int radius; } push;

void main() {
    const ivec2 size = imageSize(surroundings), texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, size))) return;
    vec2 sum = vec2(0.0);
    for (int y = -push.radius; y <= push.radius; ++y)
        for (int x = -push.radius; x <= push.radius; ++x)
            sum += texelFetch(nearness, clamp(texel + ivec2(x, y), ivec2(0), size - 1), 0).xy;
    imageStore(surroundings, texel, vec4(sum.x > 0.0 ? sum.y / sum.x : 1.0e6, 0.0, 0.0, 0.0));
}
