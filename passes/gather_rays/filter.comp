#version 460
#extension GL_GOOGLE_include_directive : require
// One level of an edge-avoiding wavelet filter (Dammertz et al. 2010) over irradiance. How alike two texels' irradiance can
// be at most is Ward's bound (Ward, Rubinstein and Clear 1988): the error of taking one for the other grows with their distance
// over the mean distance of what surrounds them, and with the angle between their normals. Beyond `tolerance` they don't mix.
layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 16) uniform sampler2D position;
layout(set = 0, binding = 17) uniform sampler2D normal;
layout(set = 0, binding = 18) uniform sampler2D source;  // Irradiance, weight.
layout(set = 0, binding = 19) uniform sampler2D surroundings;  // Harmonic mean distance, m.
layout(set = 0, binding = 20, rgba32f) writeonly uniform image2D result;
// Texels without rays of their own may have no neighbour that is alike: then any is better than none.
#define LEAST_ALIKE 1e-5

layout(push_constant) uniform Push {
    int step_;
    float tolerance;
} push;

void main() {
    const ivec2 size = imageSize(result), texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, size))) return;
    const vec4 p = texelFetch(position, texel, 0);
    if (p.w == 0.0) {
        imageStore(result, texel, vec4(0.0));
        return;
    }
    const vec3 n = texelFetch(normal, texel, 0).xyz;
    const float reach = texelFetch(surroundings, texel, 0).x;
    vec3 sum = vec3(0.0);
    float weights = 0.0, kernels = 0.0;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            const ivec2 other = texel + push.step_ * ivec2(x, y);
            if (any(lessThan(other, ivec2(0))) || any(greaterThanEqual(other, size))) continue;
            const vec4 q = texelFetch(position, other, 0);
            if (q.w == 0.0) continue;
            const float cosine = clamp(dot(n, texelFetch(normal, other, 0).xyz), 0.0, 1.0);
            const float closest = min(reach, texelFetch(surroundings, other, 0).x);
            const float error = distance(p.xyz, q.xyz) / closest + sqrt(1.0 - cosine);
            const float alike = max(1.0 - error / push.tolerance, LEAST_ALIKE);
            const float kernel = (x == 0 ? 2.0 : 1.0) * (y == 0 ? 2.0 : 1.0);
            const vec4 s = texelFetch(source, other, 0);
            sum += kernel * alike * s.w * s.rgb;
            weights += kernel * alike * s.w;
            kernels += kernel * alike;
        }
    imageStore(result, texel, weights > 0.0 ? vec4(sum / weights, weights / kernels) : vec4(0.0));
}
