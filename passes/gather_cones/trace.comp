#version 460
#extension GL_GOOGLE_include_directive : require
// Irradiance from a set of cones, for every n-th texel of the G-buffer.
#include "passes/gather_cones/cone.glsl"
#include "passes/gather_cones/cone_types.h"
#include "passes/gather_cones/sparse.glsl"
#include "shaders/sampling.glsl"
layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 16) uniform sampler2D position;
layout(set = 0, binding = 17) uniform sampler2D normal;
layout(set = 0, binding = 18) uniform sampler2D geometricNormal;
layout(set = 0, binding = 19, rgba32f) writeonly uniform image2D irradiance;
layout(set = 0, binding = 20, scalar) readonly buffer Cones { Cone data[]; } cones;
layout(push_constant) uniform Push {
    uint cones;
    int sparse;
} push;

void main() {
    const ivec2 place = ivec2(gl_GlobalInvocationID.xy);
    const ivec2 texel = tracedTexel(place, push.sparse);
    if (any(greaterThanEqual(texel, textureSize(position, 0)))) return;
    const vec4 p = texelFetch(position, texel, 0);
    vec3 sum = vec3(0.0);
    if (p.w > 0.0) {
        const vec3 n = normalize(texelFetch(normal, texel, 0).xyz);
        const vec3 side = normalize(texelFetch(geometricNormal, texel, 0).xyz);
        const vec3 dither = texelDither(texel);
        vec3 tangent, bitangent;
        frame(n, tangent, bitangent);
        const ConeBase base = coneBase(p.xyz, side);
        for (uint i = 0u; i < push.cones; ++i) {
            const Cone cone = cones.data[i];
            const float sine = sqrt(mix(cone.sineSquared.x, cone.sineSquared.y, dither.y));
            const float azimuth = cone.azimuth + 2.0 * PI * dither.x;
            const vec3 direction = normalize(sine * (cos(azimuth) * tangent + sin(azimuth) * bitangent) + sqrt(1.0 - sine * sine) * n);
            // A normal map may point cones below the surface: those see the surface itself, which reflects nothing to it.
            if (dot(direction, side) <= 0.0) continue;
            sum += cone.weight * coneRadiance(base, direction, cone.width, dither.z - 0.5);
        }
    }
    imageStore(irradiance, place, vec4(PI * sum, p.w));
}
