// A shadow ray from each virtual light of a batch to each of its random texels, with the kernel that it carries.
#include "shaders/compute/linear_index.glsl"
#include "shaders/trace/ray_types.h"
#include "passes/vpls/vpl_kernel.glsl"
#include "passes/vpls/vpls.glsl"
layout(local_size_x = 64) in;

uniform sampler2D position;
uniform sampler2D normal;
uniform sampler2D geometricNormal;
readonly buffer List { uint data[]; } list;
layout(scalar) writeonly buffer Rays { Ray data[]; } rays;
writeonly buffer Carried { float data[]; } carried;
layout(push_constant, scalar) uniform Push {
    uint first, count;         // Virtual lights of the list.
    uint points;               // Texels of each.
    uint seed;
    float minDistanceSquared;  // m²
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count * push.points) return;
    Ray ray = kNoRay;
    float kernel = 0.0;
    const Vpl vpl = vpls.data[list.data[push.first + i / push.points]];
    const ivec2 extent = textureSize(position, 0);
    const ivec2 texel = min(ivec2(sobol2(push.first * push.points + i, push.seed) * vec2(extent)), extent - 1);
    const vec4 p = texelFetch(position, texel, 0);
    if (p.w > 0.0) {
        const vec3 n = normalize(texelFetch(normal, texel, 0).xyz), face = normalize(texelFetch(geometricNormal, texel, 0).xyz);
        vec3 direction;
        const vec3 from = p.xyz + p.w * face;
        kernel = vplKernel(vpl, from, n, face, push.minDistanceSquared, direction);
        if (kernel > 0.0) ray = vplRay(vpl, from, direction);
    }
    rays.data[i] = ray;
    carried.data[i] = kernel;
}
