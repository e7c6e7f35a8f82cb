// Radiance that each pixel reflects of the irradiance between probes, averaged over its texels.
#include "passes/probes/probe_lookup.glsl"
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D position;
uniform sampler2D normal;
uniform sampler2D albedo;
layout(rgba32f) writeonly uniform image2D result;
buffer Counts {
    uint texels;
    uint unknown;
} counts;
layout(push_constant, scalar) uniform Push {
    vec3 camera;
    int samples;  // Texels of the G-buffer along an edge of a pixel.
} push;

vec3 reflected(ivec2 texel) {
    const vec4 p = texelFetch(position, texel, 0);
    if (p.w == 0.0) return vec3(0.0);
    const vec3 n = normalize(texelFetch(normal, texel, 0).xyz);
    float known;
    const vec3 irradiance = probeIrradianceAt(p.xyz, n, normalize(push.camera - p.xyz), known);
    atomicAdd(counts.texels, 1u);
    if (known == 0.0) atomicAdd(counts.unknown, 1u);
    return texelFetch(albedo, texel, 0).rgb / 3.14159265358979 * irradiance;
}

void main() {
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(result)))) return;
    vec3 sum = vec3(0.0);
    for (int j = 0; j < push.samples; ++j)
        for (int i = 0; i < push.samples; ++i) sum += reflected(pixel * push.samples + ivec2(i, j));
    imageStore(result, pixel, vec4(sum / float(push.samples * push.samples), 1.0));
}
