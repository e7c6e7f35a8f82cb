// The surfaces in a pixel, of which each needs one lookup: texels of the g-buffer that lie close together and look the same way.
#ifndef VOXRAY_GATHER_SURFELS_GROUPS_GLSL
#define VOXRAY_GATHER_SURFELS_GROUPS_GLSL

#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_buffer_reference : require
#include "shaders/scene/sampling.glsl"
#include "shaders/surfels/sorted_surfels.h"
#include "shaders/surfels/surfel_bias.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D position;
uniform sampler2D normal;
uniform sampler2D geometricNormal;
readonly buffer Begins { uint data[]; } begins;
readonly buffer Ends { uint data[]; } ends;
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer SortedSurfels { SortedSurfel data[]; };
layout(scalar) readonly buffer SortedAt { SortedSurfels sorted; };
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    ivec2 extent;  // Pixels.
    int samples;   // Texels of the g-buffer along each side of a pixel.
    float noise;   // Relative variance of a surfel's irradiance.
} push;

// GROUPS, a pixel's at most, is defined by gather_surfels.cpp.
const float NEAR = 0.25;  // Voxels.

struct Group {
    vec3 position;         // Of its first texel.
    vec3 normal;           // Unit length; shading normal.
    vec3 geometricNormal;  // Unit length.
    vec3 positions;        // Sum.
    float texels;
};

// Which group each texel joins: the first that lies so near that light can't be told apart; where there is room for no more, that of
// the least bias². Texels that show no surface have none, -1.
int joined(ivec2 texel, inout Group groups[GROUPS], inout int count) {
    const vec4 p = texelFetch(position, texel, 0);
    if (p.w == 0.0) return -1;
    const vec3 n = normalize(texelFetch(normal, texel, 0).xyz), ng = normalize(texelFetch(geometricNormal, texel, 0).xyz);
    int to = 0;
    float least = 1e30;
    bool found = false;
    for (int i = 0; i < count; ++i) {
        const bool near = distance(groups[i].position, p.xyz) < NEAR * push.grid.voxelSize && dot(groups[i].geometricNormal, ng) > 0.0;
        const float bias = planeBias(p.xyz, ng, groups[i].position, groups[i].geometricNormal) + normalBias(n, groups[i].normal);
        found = near && bias < push.noise;
        if (found || bias < least) to = i, least = bias;
        if (found) break;
    }
    if (!found && count < GROUPS) {
        to = count++;
        groups[to] = Group(p.xyz, n, ng, p.xyz, 1.0);
    } else {
        groups[to].positions += p.xyz;
        groups[to].texels += 1.0;
    }
    return to;
}

// Between which eight voxels a point lies: the first of them, and how far towards the others.
struct Eight {
    ivec3 first;
    vec3 part;
};

Eight eightAround(vec3 p) {
    const vec3 center = (p - push.grid.origin) / push.grid.voxelSize - 0.5;
    return Eight(ivec3(floor(center)), fract(center));
}

#endif
