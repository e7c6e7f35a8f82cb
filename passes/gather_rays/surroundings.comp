#version 460
// What guides the filter: the harmonic mean distance of what surrounds each texel, and how noisy a single ray is there. Both
// from the texel's own rays and those of the texels within `radius`: few rays each are too noisy a guide. Rays that miss count
// as infinitely far and black.
layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 16) uniform sampler2D moments;  // Sums of 1 / distance, luminance, its square; number of rays.
layout(set = 0, binding = 17, rg32f) writeonly uniform image2D surroundings;  // m; variance of a ray over its squared mean.
layout(push_constant) uniform Push { int radius; } push;

void main() {
    const ivec2 size = imageSize(surroundings), texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, size))) return;
    vec4 sum = vec4(0.0);
    for (int y = -push.radius; y <= push.radius; ++y)
        for (int x = -push.radius; x <= push.radius; ++x)
            sum += texelFetch(moments, clamp(texel + ivec2(x, y), ivec2(0), size - 1), 0);
    const float distance_ = sum.x > 0.0 ? sum.w / sum.x : 1.0e6;
    const float variance = sum.y > 0.0 ? max(sum.z * sum.w / (sum.y * sum.y) - 1.0, 0.0) : 0.0;
    imageStore(surroundings, texel, vec4(distance_, variance, 0.0, 0.0));
}
