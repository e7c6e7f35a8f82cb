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
// noise: relative variance of a surfel's irradiance. bias²: surfel_bias.glsl.
//
// Surfels in a gap narrower than a voxel (covered) and those with open space before them see different light: a point takes the mean
// of one kind alone, that of the surfel that counts for most.
#include "shaders/scene/sampling.glsl"
#include "shaders/surfels/radiosity.glsl"
#include "shaders/surfels/sorted_surfels.h"
#include "shaders/surfels/surfel_bias.glsl"
#include "shaders/voxels/voxel_irradiance.glsl"
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D position;
uniform sampler2D normal;
uniform sampler2D geometricNormal;
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
    float noise;  // Relative variance of a surfel's irradiance.
} push;

// Texels of a pixel that lie on one surface, closer together than light is told apart: one lookup serves all.
struct Group {
    vec3 position;         // Of the first.
    vec3 normal;           // Unit length; shading normal.
    vec3 geometricNormal;  // Unit length.
    vec3 positions;        // Sum.
    vec3 albedo;           // Sum.
    float texels;
};
const int GROUPS = 4;
const float NEAR = 0.25;  // Voxels.

// Of surfels of one kind.
struct Mean {
    vec3 sum;
    float weights;
    float heaviest;
};

vec3 irradianceAt(vec3 p, vec3 n, vec3 ng) {
    const VoxelGrid g = push.grid;
    const vec3 center = (p - g.origin) / g.voxelSize - 0.5, corner = floor(center), part = center - corner;
    Mean open = Mean(vec3(0.0), 0.0, 0.0), covered = open;
    for (int v = 0; v < 8; ++v) {
        const ivec3 far = ivec3(v & 1, (v >> 1) & 1, v >> 2);
        const vec3 along = mix(1.0 - part, part, vec3(far));
        const uint number = voxelNumber(g, ivec3(corner) + far);
        if (number == NO_VOXEL) continue;
        const float tent = along.x * along.y * along.z;
        const uint end = ends.data[number];
        for (uint i = begins.data[number]; i < end; ++i) {
            const SortedSurfel s = sorted.data[i];
            if (dot(s.normal, ng) <= 0.0) continue;
            const float bias = planeBias(p, ng, s.position, s.normal) + normalBias(n, s.normal);
            const float weight = tent * push.noise / (push.noise + bias);
            const vec3 weighted = weight * unpackRadiosity(light.data[i]);
            if ((s.id & VOXRAY_COVERED) == 0u)
                open = Mean(open.sum + weighted, open.weights + weight, max(open.heaviest, weight));
            else
                covered = Mean(covered.sum + weighted, covered.weights + weight, max(covered.heaviest, weight));
        }
    }
    if (covered.heaviest > open.heaviest) return covered.sum / covered.weights;
    return open.weights > 0.0 ? open.sum / open.weights : voxelIrradiance(g, p, ng, 1.0, false);
}

bool sameLight(Group group, vec3 p, vec3 n, vec3 ng) {
    return distance(group.position, p) < NEAR * push.grid.voxelSize && dot(group.geometricNormal, ng) > 0.0 &&
           planeBias(p, ng, group.position, group.geometricNormal) + normalBias(n, group.normal) < push.noise;
}

vec3 reflected(Group group) {
    return group.albedo / PI * irradianceAt(group.positions / group.texels, group.normal, group.geometricNormal);
}

void main() {
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(result)))) return;

    // Sort the pixel's texels into groups.
    Group groups[GROUPS];
    int count = 0;
    vec3 sum = vec3(0.0);
    for (int t = 0; t < push.samples * push.samples; ++t) {
        const ivec2 texel = pixel * push.samples + ivec2(t % push.samples, t / push.samples);
        const vec4 p = texelFetch(position, texel, 0);
        if (p.w == 0.0) continue;
        const vec3 n = normalize(texelFetch(normal, texel, 0).xyz), ng = normalize(texelFetch(geometricNormal, texel, 0).xyz);
        const vec3 a = texelFetch(albedo, texel, 0).rgb;
        int found = 0;
        while (found < count && !sameLight(groups[found], p.xyz, n, ng)) ++found;
        if (found == GROUPS) {
            sum += reflected(Group(p.xyz, n, ng, p.xyz, a, 1.0));  // Room for no more.
        } else if (found == count) {
            groups[count++] = Group(p.xyz, n, ng, p.xyz, a, 1.0);
        } else {
            groups[found].positions += p.xyz;
            groups[found].albedo += a;
            groups[found].texels += 1.0;
        }
    }

    // Look each group up.
    for (int i = 0; i < count; ++i) sum += reflected(groups[i]);
    imageStore(result, pixel, vec4(sum / float(push.samples * push.samples), 1.0));
}
