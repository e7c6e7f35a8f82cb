// Reflected radiance of each pixel: albedo / pi times filtered irradiance, averaged over its texels. With SPECULAR the
// reflection of specular lobes is added, and the diffuse one scaled by what they leave to it.
#include "passes/cones/radiance/texel_stride.glsl"
#include "shaders/scene/sampling.glsl"
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D irradiance;
uniform sampler2D albedo;
uniform sampler2D position;
uniform sampler2D normal;
layout(rgba32f) writeonly uniform image2D result;
#ifdef SPECULAR
uniform sampler2D reflected;
#endif
layout(push_constant, scalar) uniform Push {
    int samples;
    int stride;
    float voxelSize;  // m
} push;

// Mean over about 25 traced texels, which averages out their cones' different directions. Weights fall with the
// distance from the tangent plane, in voxels (cones resolve no finer detail), and with the angle between the normals
// (the error bound of Ward et al. 1988).
vec3 filteredIrradiance(ivec2 texel) {
    const vec4 p = texelFetch(position, texel, 0);
    if (p.w == 0.0) return vec3(0.0);
    const vec3 n = normalize(texelFetch(normal, texel, 0).xyz);
    const ivec2 size = textureSize(position, 0);
    const int reach = int(ceil(2.5 * sqrt(float(push.stride)) - 0.5));
    vec3 sum = vec3(0.0);
    float weights = 0.0;
    for (int y = max(texel.y - reach, 0); y <= min(texel.y + reach, size.y - 1); ++y) {
        const int shift = rowShift(y, push.stride);
        const int first = (max(texel.x - reach, 0) - shift + push.stride - 1) / push.stride;
        const int last = (min(texel.x + reach, size.x - 1) - shift + push.stride) / push.stride - 1;
        for (int i = first; i <= last; ++i) {
            const ivec2 neighbor = ivec2(i * push.stride + shift, y);
            const vec4 q = texelFetch(position, neighbor, 0);
            if (q.w == 0.0) continue;
            const float angle = sqrt(max(1.0 - dot(n, normalize(texelFetch(normal, neighbor, 0).xyz)), 0.0));
            const float weight = max(1.0 - abs(dot(n, q.xyz - p.xyz)) / push.voxelSize - angle, 0.0);
            sum += weight * texelFetch(irradiance, ivec2(i, y), 0).rgb;
            weights += weight;
        }
    }
    return weights > 0.0 ? sum / weights : vec3(0.0);
}

void main() {
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(result)))) return;
    vec3 sum = vec3(0.0);
    for (int y = 0; y < push.samples; ++y)
        for (int x = 0; x < push.samples; ++x) {
            const ivec2 texel = pixel * push.samples + ivec2(x, y);
            const vec3 diffuse = texelFetch(albedo, texel, 0).rgb * filteredIrradiance(texel);
#ifdef SPECULAR
            const vec4 specular = texelFetch(reflected, texel, 0);
            sum += specular.a * diffuse + PI * specular.rgb;
#else
            sum += diffuse;
#endif
        }
    imageStore(result, pixel, vec4(sum / (PI * float(push.samples * push.samples)), 1.0));
}
