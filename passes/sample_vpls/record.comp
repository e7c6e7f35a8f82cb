#version 460
#extension GL_GOOGLE_include_directive : require
// Leaves a virtual point light where each ray hit, then turns the ray into its next bounce.
#include "shaders/compute/linear_index.glsl"
#include "shaders/light_paths/light_bounce.glsl"
#include "shaders/vpls/vpl_types.h"
layout(local_size_x = 64) in;

layout(scalar) buffer Rays { Ray data[]; } rays;
layout(scalar) buffer Paths { LightPath data[]; } paths;
layout(scalar) readonly buffer Hits { Hit data[]; } hits;
readonly buffer Order { uint data[]; } order;  // The place of each path among those of all sources.
layout(scalar) writeonly buffer Vpls { Vpl data[]; } vpls;
buffer Flags { uint words[]; } flags;
layout(push_constant, scalar) uniform Push {
    uint paths;
    uint firstPath;  // Of the source.
    uint seed;
    uint bounce;
    uint bounces;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.paths) return;
    Ray ray = rays.data[i];
    if (ray.tMax < ray.tMin) return;
    rays.data[i].tMax = -1.0;
    const Hit hit = hits.data[i];
    if (hit.triangle == NO_HIT) return;

    // The point reflects what its ray carries
    const SurfacePoint s = surfacePoint(hit.triangle, vec2(hit.u, hit.v));
    if (dot(s.geometricNormal, s.geometricNormal) == 0.0) return;
    const vec3 faceNormal = litSide(s, ray.direction);
    const GpuMaterial m = sceneMaterials.data[s.material];
    LightPath path = paths.data[i];
    const vec3 flux = path.power * litAlbedo(m, s);
    if (any(greaterThan(flux, vec3(0.0)))) {
        const uint number = order.data[push.firstPath + i] * push.bounces + push.bounce;
        vpls.data[number] = Vpl(s.position, litNormal(m, s, faceNormal), faceNormal, flux);
        atomicOr(flags.words[number / 32u], 1u << (number % 32u));
    }
    if (push.bounce + 1u == push.bounces) return;
    if (!bounceLightRay(s, faceNormal, false, i, hashCombine(push.seed, 16u + 2u * push.bounce), ray, path)) return;
    paths.data[i] = path;
    rays.data[i] = ray;
}
