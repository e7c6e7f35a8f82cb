#version 460
// What guides the filter: the harmonic mean distance of what surrounds each texel, and how noisy a single ray is there. Both
// from the texel's own rays and those of the texels within `radius`: few rays each are too noisy a guide. Rays that miss count
// as infinitely far and black. The sums over the square are taken along rows first, then, with COLUMNS, along columns.
layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 16) uniform sampler2D moments;  // Sums of 1 / distance, luminance, its square; number of rays.
#ifdef COLUMNS
layout(set = 0, binding = 17, rg32f) writeonly uniform image2D surroundings;  // m; variance of a ray over its squared mean.
const ivec2 along = ivec2(0, 1);
#else
layout(set = 0, binding = 17, rgba32f) writeonly uniform image2D rowSums;
const ivec2 along = ivec2(1, 0);
#endif
layout(push_constant) uniform Push { int radius; } push;

void main() {
    const ivec2 size = textureSize(moments, 0), texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, size))) return;
    vec4 sum = vec4(0.0);
    for (int i = -push.radius; i <= push.radius; ++i)
        sum += texelFetch(moments, clamp(texel + i * along, ivec2(0), size - 1), 0);
#ifdef COLUMNS
    const float distance_ = sum.x > 0.0 ? sum.w / sum.x : 1.0e6;
    const float variance = sum.y > 0.0 ? max(sum.z * sum.w / (sum.y * sum.y) - 1.0, 0.0) : 0.0;
    imageStore(surroundings, texel, vec4(distance_, variance, 0.0, 0.0));
#else
    imageStore(rowSums, texel, sum);
#endif
}
