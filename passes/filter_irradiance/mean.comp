#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
// One level of a plain edge-avoiding à-trous wavelet (Dammertz et al. 2010), stopped by geometry alone: the mean light of a texel's
// surroundings on the same surface. Texels' means are compared to tell whether light differs between them (wavelet.comp).
#include "passes/filter_irradiance/wavelet.glsl"
#include "shaders/scene/sampling.glsl"
layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar) readonly buffer Guide { FilterTexel data[]; } guide;
// At level 0 irradiance and number of rays, later the result of the level before.
uniform sampler2D source;
// Mean luminance, W/m²; rays of a texel; sum of their squared weights, so that the mean stands for rays² / squares of them.
layout(rgba32f) writeonly uniform image2D result;
layout(push_constant) uniform Push { int level; } push;

// Weights fall to a half where normals differ by 33 degrees, or the line between the texels leaves the surface by 15.
#define NORMAL_EXPONENT 4
#define OFF_PLANE_FALLOFF 10.0

void main() {
    const ivec2 size = imageSize(result), texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, size))) return;
    const FilterTexel own = guide.data[texel.y * size.x + texel.x];
    if (own.gradient < 0.0) {
        imageStore(result, texel, vec4(0.0));
        return;
    }

    const vec3 normal = fromOctahedral(own.normal);
    float luminances = 0.0, rays = 0.0, squares = 0.0, weights = 0.0;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            const ivec2 at = texel + (ivec2(x, y) << push.level);
            if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, size))) continue;
            const FilterTexel other = guide.data[at.y * size.x + at.x];
            if (other.gradient < 0.0) continue;
            const vec4 from = texelFetch(source, at, 0);
            const vec3 light = push.level == 0 ? vec3(luminance(from.rgb), from.aa) : from.rgb;
            const float cosine = max(dot(normal, fromOctahedral(other.normal)), 0.0);
            const float kernel = (x == 0 ? 2.0 : 1.0) * (y == 0 ? 2.0 : 1.0);
            const float weight =
                kernel * pow(cosine, NORMAL_EXPONENT) * exp(-OFF_PLANE_FALLOFF * offPlane(own, other));
            luminances += weight * light.y * light.x;
            rays += weight * light.y;
            squares += weight * weight * light.z;
            weights += weight;
        }

    imageStore(result, texel,
               vec4(rays > 0.0 ? luminances / rays : 0.0, rays / weights, overlap(push.level) * squares / (weights * weights), 0.0));
}
