#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// What guides the filter at each texel, in one place: its surface, and what its block knows of light, interpolated between
// blocks' centers.
#include "shaders/scene/octahedral.glsl"
#include "shaders/filter/gather_filter.h"
#include "shaders/view/gather_types.h"
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D position;
uniform sampler2D normal;
layout(scalar) readonly buffer Blocks { vec2 data[]; } blocks;  // Change, 1/m; variance.
layout(scalar) writeonly buffer Guide { FilterTexel data[]; } guide;
layout(push_constant, scalar) uniform Push {
    GatherLayout layout_;
    vec3 camera;       // m
    float texelAngle;  // Width of a texel at unit distance.
} push;

// Light from what is nearer than some texels changes within them anyhow: no bound is sharper than that (as Tabellion and
// Lamorlette 2004 bound the radius of irradiance records by the pixel).
#define MIN_TEXELS 8.0

vec2 blockAt(ivec2 block) {
    const ivec2 inside = clamp(block, ivec2(0), ivec2(push.layout_.blocks) - 1);
    return blocks.data[inside.y * int(push.layout_.blocks.x) + inside.x];
}

void main() {
    const GatherLayout g = push.layout_;
    const uvec2 texel = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(texel, g.texels))) return;
    const uint index = texel.y * g.texels.x + texel.x;
    const vec4 p = texelFetch(position, ivec2(texel), 0);
    if (p.w == 0.0) {
        guide.data[index] = FilterTexel(vec3(0.0), 0u, -1.0, 0.0);
        return;
    }

    const vec2 at = (vec2(texel) + 0.5) / float(g.blockSize) - 0.5, part = fract(at);
    const ivec2 corner = ivec2(floor(at));
    const vec2 light = mix(mix(blockAt(corner), blockAt(corner + ivec2(1, 0)), part.x),
                           mix(blockAt(corner + ivec2(0, 1)), blockAt(corner + ivec2(1, 1)), part.x), part.y);
    const float most = sqrt(light.y) / (MIN_TEXELS * push.texelAngle * distance(p.xyz, push.camera));
    guide.data[index] =
        FilterTexel(p.xyz, toOctahedral(texelFetch(normal, ivec2(texel), 0).xyz), min(light.x, most), light.y);
}
