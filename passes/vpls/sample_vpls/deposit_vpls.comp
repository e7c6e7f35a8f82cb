// Deposits a virtual point light where each ray hit, then scatters the ray. VOXEL_HITS: the rays hit surface voxels.
// VOXEL_NEXT: scattered rays will.
#include "shaders/compute/linear_index.glsl"
#include "passes/inject/light_paths/light_bounce.glsl"
#ifdef VOXEL_NEXT
#include "passes/vpls/sample_vpls/voxel_vertex.glsl"
#endif
#include "shaders/voxels/voxel_types.h"
#include "passes/vpls/vpls.glsl"
layout(local_size_x = 64) in;

layout(scalar) buffer Rays { Ray data[]; } rays;
layout(scalar) buffer Paths { LightPath data[]; } paths;
layout(scalar) readonly buffer Hits { Hit data[]; } hits;
readonly buffer PathOrder { uint data[]; } pathOrder;  // By path in the order of sources: its index in Vpls.
buffer Flags { uint words[]; } flags;
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;  // That scattered rays hit voxels of; unused where they hit triangles.
    uint count;      // Paths of the batch.
    uint firstPath;  // Of the batch, among all sources' paths.
    uint firstRay;   // Of the batch, among its source's paths.
    uint seed;
    uint bounce;
    uint bounces;
} push;

// False for a triangle without area.
bool lightVertexAtHit(Ray ray, Hit hit, out LightVertex p) {
#ifdef VOXEL_HITS
    p = voxelVertex(hit.triangle, ray.origin + hit.t * ray.direction, ray.direction);
#else
    const SurfacePoint s = surfacePoint(hit.triangle, vec2(hit.u, hit.v));
    if (dot(s.geometricNormal, s.geometricNormal) == 0.0) return false;
    p = lightVertex(s, ray.direction);
#endif
    return true;
}

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    Ray ray = rays.data[i];
    if (ray.tMax < ray.tMin) return;
    rays.data[i].tMax = -1.0;
    const Hit hit = hits.data[i];
    if (hit.triangle == NO_HIT) return;

    LightVertex p;
    if (!lightVertexAtHit(ray, hit, p)) return;
    LightPath path = paths.data[i];
    const float factor = adjointFactor(p, ray.direction);
    if (factor == 0.0) return;
    path.power *= factor;
    p.normal = p.faceNormal;  // Light leaves by the cosine to the face normal, for which adjointFactor() is 1
    const vec3 flux = path.power * p.albedo;
    if (any(greaterThan(flux, vec3(0.0)))) {
        const uint vplIndex = pathOrder.data[push.firstPath + i] * push.bounces + push.bounce;
        vpls.data[vplIndex] = Vpl(p.position + p.offset * p.faceNormal, p.faceNormal, flux);
        atomicOr(flags.words[vplIndex / 32u], 1u << (vplIndex % 32u));
    }
    if (push.bounce + 1u == push.bounces) return;
    if (!bounceLightRay(p, false, push.firstRay + i, hashCombine(push.seed, 16u + 2u * push.bounce), ray, path)) return;
#ifdef VOXEL_NEXT
    ray.origin = rayOriginOffVoxels(push.grid, p.position, p.faceNormal, ray.direction);
#endif
    paths.data[i] = path;
    rays.data[i] = ray;
}
