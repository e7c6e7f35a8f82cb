#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// A shadow ray from each texel of a batch to each virtual light of it, with the irradiance that comes along it if nothing is in the
// way (Sun and Agu 2015, equations 1 to 4).
#include "passes/gather_vpls/batch.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/sampling.glsl"
#include "shaders/trace/ray_types.h"
#include "shaders/vpls/vpl_types.h"
layout(local_size_x = 64) in;

uniform sampler2D position;
uniform sampler2D normal;
uniform sampler2D geometricNormal;
layout(scalar) readonly buffer Vpls { Vpl data[]; } vpls;
readonly buffer List { uint data[]; } list;
layout(scalar) writeonly buffer Rays { Ray data[]; } rays;
layout(scalar) writeonly buffer Carried { vec4 data[]; } carried;
layout(push_constant, scalar) uniform Push {
    Batch batch;
    float minDistanceSquared;  // m²
    float minOffset;           // m: rays start and end at least as far from their surfaces.
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.batch.texelCount * push.batch.vplCount) return;
    Ray ray = Ray(vec3(0.0), 0.0, vec3(0.0, 0.0, 1.0), -1.0);
    vec3 irradiance = vec3(0.0);
    const ivec2 texel = batchTexel(push.batch, i % push.batch.texelCount);
    const vec4 p = isOutside(push.batch, texel) ? vec4(0.0) : texelFetch(position, texel, 0);
    if (p.w > 0.0) {
        const Vpl vpl = vpls.data[list.data[push.batch.firstVpl + i / push.batch.texelCount]];
        const vec3 n = normalize(texelFetch(normal, texel, 0).xyz), face = normalize(texelFetch(geometricNormal, texel, 0).xyz);
        const vec3 way = vpl.position - p.xyz;
        const float squared = dot(way, way);
        const vec3 direction = way * inversesqrt(max(squared, 1e-30));
        const float cosine = dot(n, direction), vplCosine = -dot(vpl.normal, direction);
        const bool isAbove = dot(face, direction) > 0.0 && dot(vpl.faceNormal, direction) < 0.0;
        if (cosine > 0.0 && vplCosine > 0.0 && isAbove && squared > 0.0) {
            // A Lambert surface's radiant intensity: flux times cosine over pi
            irradiance = vpl.flux * (cosine * vplCosine / (PI * max(squared, push.minDistanceSquared)));

            const vec3 from = p.xyz + face * max(surfaceOffset(p.xyz), push.minOffset);
            const vec3 to = vpl.position + vpl.faceNormal * max(surfaceOffset(vpl.position), push.minOffset);
            const vec3 between = to - from;
            const float distance_ = length(between);
            // Ends that have passed each other have nothing between them: no ray, and the light arrives
            if (dot(between, direction) > 0.0) ray = Ray(from, 0.0, between / distance_, distance_);
        }
    }
    rays.data[i] = ray;
    carried.data[i] = vec4(irradiance, 0.0);
}
