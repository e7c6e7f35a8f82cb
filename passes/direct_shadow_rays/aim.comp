#version 460
#extension GL_GOOGLE_include_directive : require
// One shadow ray a pixel towards a light, with the radiance that the pixel reflects if nothing is in the way.
#include "shaders/lights.glsl"
#include "shaders/sampling.glsl"
#include "shaders/scene.glsl"
#include "shaders/shared/ray_types.h"
layout(local_size_x = 8, local_size_y = 8) in;

#define PUNCTUAL 0u
#define EMITTERS 1u

layout(set = 0, binding = 16) uniform sampler2D position;
layout(set = 0, binding = 17) uniform sampler2D normal;
layout(set = 0, binding = 18) uniform sampler2D geometricNormal;
layout(set = 0, binding = 19) uniform sampler2D albedo;
layout(set = 0, binding = 20, scalar) writeonly buffer Rays { Ray data[]; } rays;
layout(set = 0, binding = 21, scalar) writeonly buffer Carried { vec4 data[]; } carried;
layout(push_constant, scalar) uniform Push {
    uint kind;
    uint light;
    uint samples;
    uint width;
    uint height;
    uint seed;
    uint emitterCount;
} push;

void main() {
    const uvec2 pixel = gl_GlobalInvocationID.xy;
    if (pixel.x >= push.width || pixel.y >= push.height) return;
    const uint index = pixel.y * push.width + pixel.x;
    Ray ray;
    ray.origin = vec3(0.0);
    ray.direction = vec3(0.0, 0.0, 1.0);
    ray.tMin = 0.0;
    ray.tMax = -1.0;
    vec3 radiance = vec3(0.0);
    const vec4 p = texelFetch(position, ivec2(pixel), 0);
    if (p.w > 0.0) {
        const vec3 n = normalize(texelFetch(normal, ivec2(pixel), 0).xyz);
        const vec3 side = normalize(texelFetch(geometricNormal, ivec2(pixel), 0).xyz);

        // Irradiance on a plane facing the sample, were it not in shadow.
        LightSample s;
        const uint seed = hashCombine(push.seed, index);
        if (push.kind == PUNCTUAL) {
            s = samplePunctual(sceneLights.data[push.light], p.xyz);
        } else if (push.kind == EMITTERS) {
            const vec2 u = sobol2(push.light, hashCombine(seed, 0u));
            const float pick = sobol2(push.light, hashCombine(seed, 1u)).x;
            s = sampleEmitters(push.emitterCount, p.xyz, pick, u);
            s.irradiance /= float(push.samples);
        } else {
            // By cosine about the normal: radiance * cos / (cos / pi).
            s.direction = cosineDirection(sobol2(push.light, hashCombine(seed, 2u)), n);
            s.distance_ = 1.0e30;
            s.irradiance = environmentRadiance(s.direction) * PI / (float(push.samples) * max(dot(n, s.direction), 1e-6));
        }

        const float cosine = dot(n, s.direction);
        if (cosine > 0.0 && dot(side, s.direction) > 0.0) {
            radiance = texelFetch(albedo, ivec2(pixel), 0).rgb / PI * s.irradiance * cosine;
            const float offset = surfaceOffset(p.xyz);
            ray.origin = p.xyz + side * offset;
            ray.direction = s.direction;
            ray.tMax = s.distance_ - 2.0 * offset;
        }
    }
    if (all(equal(radiance, vec3(0.0)))) ray.tMax = -1.0;
    rays.data[index] = ray;
    carried.data[index] = vec4(radiance, 0.0);
}
