// A shadow ray from a random texel to a virtual light, texelsPerVpl for each light of a batch, with its geometry term.
#include "shaders/compute/linear_index.glsl"
#include "shaders/trace/ray_types.h"
#include "passes/vpls/vpl_geometry_term.glsl"
#include "passes/vpls/vpls.glsl"
layout(local_size_x = 64) in;

uniform sampler2D position;
uniform sampler2D normal;
uniform sampler2D geometricNormal;
readonly buffer ActiveVpls { uint data[]; } activeVpls;
layout(scalar) writeonly buffer Rays { Ray data[]; } rays;
writeonly buffer GeometryTerms { float data[]; } geometryTerms;
layout(push_constant, scalar) uniform Push {
    uint first, count;         // Range of the active lights.
    uint texelsPerVpl;
    uint seed;
    float minDistanceSquared;  // m²
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count * push.texelsPerVpl) return;
    Ray ray = kNoRay;
    float geometry = 0.0;
    const Vpl vpl = vpls.data[activeVpls.data[push.first + i / push.texelsPerVpl]];
    const ivec2 extent = textureSize(position, 0);
    const ivec2 texel = min(ivec2(sobol2(push.first * push.texelsPerVpl + i, push.seed) * vec2(extent)), extent - 1);
    const vec4 p = texelFetch(position, texel, 0);
    if (p.w > 0.0) {
        const vec3 n = normalize(texelFetch(normal, texel, 0).xyz);
        const vec3 faceNormal = normalize(texelFetch(geometricNormal, texel, 0).xyz);
        vec3 direction;
        const vec3 origin = p.xyz + p.w * faceNormal;
        geometry = vplGeometryTerm(vpl, origin, n, faceNormal, push.minDistanceSquared, direction);
        if (geometry > 0.0) ray = vplRay(vpl, origin, direction);
    }
    rays.data[i] = ray;
    geometryTerms.data[i] = geometry;
}
