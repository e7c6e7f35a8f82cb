#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_buffer_reference : require
// Radiance that each pixel's surface reflects of the irradiance that surfels around it hold.
//
// Each surfel of the eight voxels around a point counts by the tent weights of these voxels, times
//
//     noise / (noise + bias²)
//
// as the taps of filter_irradiance do: it helps as long as the noise that it averages out outweighs the bias that it brings.
// noise: relative variance of a surfel's irradiance, of which a ray is taken to have 1. bias²: surfel_bias.glsl.
#include "shaders/surfels/radiosity.glsl"
#include "shaders/surfels/sorted_surfels.h"
#include "shaders/surfels/surfel_bias.glsl"
#include "shaders/voxels/voxel_irradiance.glsl"
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D position;
uniform sampler2D normal;
uniform sampler2D albedo;
readonly buffer Begins { uint data[]; } begins;
readonly buffer Ends { uint data[]; } ends;
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer SortedSurfels { SortedSurfel data[]; };
layout(scalar) readonly buffer SortedAt { SortedSurfels sorted; };
layout(scalar) readonly buffer LightAt { LargeUints light; };
layout(rgba32f) writeonly uniform image2D result;
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    int samples;  // Texels of the g-buffer along each side of a pixel.
    float noise;
} push;

vec3 irradianceAt(vec3 p, vec3 n) {
    const VoxelGrid g = push.grid;
    const vec3 center = (p - g.origin) / g.voxelSize - 0.5, corner = floor(center), part = center - corner;
    vec3 sum = vec3(0.0);
    float weights = 0.0;
    for (int v = 0; v < 8; ++v) {
        const ivec3 far = ivec3(v & 1, (v >> 1) & 1, v >> 2);
        const vec3 along = mix(1.0 - part, part, vec3(far));
        const uint number = voxelNumber(g, ivec3(corner) + far);
        if (number == NO_VOXEL) continue;
        const float tent = along.x * along.y * along.z;
        const uint end = ends.data[number];
        for (uint i = begins.data[number]; i < end; ++i) {
            const SortedSurfel s = sorted.data[i];
            if (dot(s.normal, n) <= 0.0) continue;
            const float weight = tent * push.noise / (push.noise + surfelBias(p, n, s.position, s.normal));
            sum += weight * unpackRadiosity(light.data[i]);
            weights += weight;
        }
    }
    return weights > 0.0 ? sum / weights : voxelIrradiance(g, p, n, 1.0, false);
}

vec3 reflected(ivec2 texel) {
    const vec4 p = texelFetch(position, texel, 0);
    if (p.w == 0.0) return vec3(0.0);
    return texelFetch(albedo, texel, 0).rgb / 3.14159265358979 * irradianceAt(p.xyz, normalize(texelFetch(normal, texel, 0).xyz));
}

void main() {
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(result)))) return;
    vec3 sum = vec3(0.0);
    for (int j = 0; j < push.samples; ++j)
        for (int i = 0; i < push.samples; ++i) sum += reflected(pixel * push.samples + ivec2(i, j));
    imageStore(result, pixel, vec4(sum / float(push.samples * push.samples), 1.0));
}
