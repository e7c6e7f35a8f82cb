#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
// One level of an edge-avoiding wavelet filter (Dammertz et al. 2010) over irradiance, which weighs noise against bias.
//
// How much the irradiance of two texels may differ is Ward's bound (Ward, Rubinstein and Clear 1988): relative to either, at most
// about their distance over the mean distance of what surrounds them, plus sqrt(1 - n n'). How noisy a texel is, is the relative
// variance of a ray over the number of rays that its value stands for. A neighbour helps as long as the noise that it averages out
// outweighs the bias that it brings: its weight is noise / (noise + bias²). The more rays, the narrower the filter; in the limit
// there is none.
layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 16) uniform sampler2D position;
layout(set = 0, binding = 17) uniform sampler2D normal;
layout(set = 0, binding = 18) uniform sampler2D source;  // Irradiance, number of rays that it stands for.
layout(set = 0, binding = 19) uniform sampler2D surroundings;  // Harmonic mean distance, m; relative variance of a ray.
layout(set = 0, binding = 20, rgba32f) writeonly uniform image2D result;
layout(push_constant, scalar) uniform Push {
    vec3 camera;       // m
    float texelAngle;  // Width of a texel at unit distance.
    int step_;
    float strictness;
} push;

// Light from what is nearer than some texels changes within them anyhow: surroundings count as no nearer (as Tabellion and
// Lamorlette 2004 bound the radius of irradiance records by the pixel).
#define LEAST_TEXELS 8.0

void main() {
    const ivec2 size = imageSize(result), texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, size))) return;
    const vec4 p = texelFetch(position, texel, 0);
    if (p.w == 0.0) {
        imageStore(result, texel, vec4(0.0));
        return;
    }
    const vec3 n = texelFetch(normal, texel, 0).xyz;
    const vec2 around = texelFetch(surroundings, texel, 0).xy;
    const float noise = around.y / max(texelFetch(source, texel, 0).w, 1e-3);
    const float least = LEAST_TEXELS * push.texelAngle * distance(p.xyz, push.camera);
    vec3 sum = vec3(0.0);
    float weights = 0.0, variance = 0.0;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            const ivec2 other = texel + push.step_ * ivec2(x, y);
            if (any(lessThan(other, ivec2(0))) || any(greaterThanEqual(other, size))) continue;
            const vec4 q = texelFetch(position, other, 0);
            const vec4 s = texelFetch(source, other, 0);
            if (q.w == 0.0 || s.w == 0.0) continue;
            const float cosine = clamp(dot(n, texelFetch(normal, other, 0).xyz), 0.0, 1.0);
            const float closest = max(min(around.x, texelFetch(surroundings, other, 0).x), least);
            const float bias = push.strictness * (distance(p.xyz, q.xyz) / closest + sqrt(1.0 - cosine));
            const float kernel = (x == 0 ? 2.0 : 1.0) * (y == 0 ? 2.0 : 1.0);
            const float weight = kernel * s.w * (noise + 1e-12) / (noise + 1e-12 + bias * bias);
            sum += weight * s.rgb;
            weights += weight;
            variance += weight * weight / s.w;
        }
    imageStore(result, texel, weights > 0.0 ? vec4(sum / weights, weights * weights / variance) : vec4(0.0));
}
