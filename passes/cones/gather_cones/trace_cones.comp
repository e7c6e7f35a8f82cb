// Irradiance by a set of cones, for every n-th texel of the G-buffer.
#include "passes/cones/radiance/texel_stride.glsl"
#include "passes/cones/radiance/cone_set.glsl"
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D position;
uniform sampler2D normal;
uniform sampler2D geometricNormal;
layout(rgba32f) writeonly uniform image2D irradiance;
layout(push_constant) uniform Push {
    uint coneCount;
    int stride;
} push;

void main() {
    const ivec2 traced = ivec2(gl_GlobalInvocationID.xy);
    const ivec2 texel = tracedTexel(traced, push.stride);
    if (any(greaterThanEqual(texel, textureSize(position, 0)))) return;
    const vec4 p = texelFetch(position, texel, 0);
    vec3 irradiance_ = vec3(0.0);
    if (p.w > 0.0) {
        const vec3 ns = normalize(texelFetch(normal, texel, 0).xyz);
        const vec3 ng = normalize(texelFetch(geometricNormal, texel, 0).xyz);
        irradiance_ = coneIrradiance(p.xyz, ng, ns, push.coneCount, texelDither(texel));
    }
    imageStore(irradiance, traced, vec4(irradiance_, p.w));
}
