// Leaves a virtual point light where each ray hit, then turns the ray into its next bounce. With VOXEL_HITS rays hit surface voxels, and
// with VOXEL_NEXT those that go on will.
#include "shaders/compute/linear_index.glsl"
#include "passes/inject/light_paths/light_bounce.glsl"
#ifdef VOXEL_NEXT
#include "passes/vpls/sample_vpls/voxel_bounce.glsl"
#endif
#include "shaders/voxels/voxel_types.h"
#include "passes/vpls/vpls.glsl"
layout(local_size_x = 64) in;

layout(scalar) buffer Rays { Ray data[]; } rays;
layout(scalar) buffer Paths { LightPath data[]; } paths;
layout(scalar) readonly buffer Hits { Hit data[]; } hits;
readonly buffer Order { uint data[]; } order;  // The place of each path among those of all sources.
buffer Flags { uint words[]; } flags;
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;  // That rays of further bounces meet voxels of; not read where they meet triangles.
    uint count;      // Paths of the batch.
    uint firstPath;  // Of the batch, among those of all sources.
    uint firstRay;   // The same, of its source's.
    uint seed;
    uint bounce;
    uint bounces;
} push;

// False where the ray hit a triangle without area.
bool pointAtHit(Ray ray, Hit hit, out LitPoint p) {
#ifdef VOXEL_HITS
    p = litVoxel(hit.triangle, ray.origin + hit.t * ray.direction, ray.direction);
#else
    const SurfacePoint s = surfacePoint(hit.triangle, vec2(hit.u, hit.v));
    if (dot(s.geometricNormal, s.geometricNormal) == 0.0) return false;
    p = litPoint(s, ray.direction);
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

    // The point reflects what its ray carries
    LitPoint p;
    if (!pointAtHit(ray, hit, p)) return;
    LightPath path = paths.data[i];
    // Power falls on the triangle, light is reflected by the cosine to the shading normal and leaves by that to the triangle's: so light
    // takes the way that paths from the camera take (Veach 1997, section 5.3)
    const float arrives = -dot(p.normal, ray.direction), falls = -dot(p.faceNormal, ray.direction);
    if (arrives <= 0.0 || falls <= 0.0) return;
    path.power *= arrives / falls;
    p.normal = p.faceNormal;
    const vec3 flux = path.power * p.albedo;
    if (any(greaterThan(flux, vec3(0.0)))) {
        const uint number = order.data[push.firstPath + i] * push.bounces + push.bounce;
        vpls.data[number] = Vpl(p.position + p.offset * p.faceNormal, p.normal, p.faceNormal, flux);
        atomicOr(flags.words[number / 32u], 1u << (number % 32u));
    }
    if (push.bounce + 1u == push.bounces) return;
    if (!bounceLightRay(p, false, push.firstRay + i, hashCombine(push.seed, 16u + 2u * push.bounce), ray, path)) return;
#ifdef VOXEL_NEXT
    ray.origin = beginInVoxels(push.grid, p.position, p.faceNormal, ray.direction);
#endif
    paths.data[i] = path;
    rays.data[i] = ray;
}
