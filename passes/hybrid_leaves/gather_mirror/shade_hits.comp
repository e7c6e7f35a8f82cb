// Shades the hits of rays: emission, and reflected light from voxels; at hits on mirrors it generates the next rays.
#include "passes/hybrid_leaves/gather_mirror/batch.glsl"
#include "passes/hybrid_leaves/gather_mirror/diffuse_fraction.glsl"
#include "shaders/scene/lobe_ray.glsl"
#include "passes/hybrid_leaves/gather_mirror/hit_surface.glsl"
#include "passes/surfels/surfel_types.h"
#include "shaders/voxels/face_irradiance.glsl"
layout(local_size_x = 64) in;
layout(constant_id = 0) const bool kShadowRays = false;  // Direct light by shadow rays, not from voxels.

layout(scalar) readonly buffer Grid { VoxelGrid data; } grid;
layout(scalar) readonly buffer Paths { MirrorPath data[]; } paths;
layout(scalar) readonly buffer Rays { Ray data[]; } rays;
layout(scalar) readonly buffer Hits { Hit data[]; } hits;
layout(scalar) writeonly buffer NextPaths { MirrorPath data[]; } nextPaths;
layout(scalar) writeonly buffer NextRays { Ray data[]; } nextRays;
#ifdef HYBRID
layout(scalar) writeonly buffer NextStarts { RayStart data[]; } nextStarts;
#endif
// Where direct light is sampled; `parent` is the path's index.
layout(scalar) writeonly buffer Surfels { Surfel data[]; } surfels;
layout(scalar) buffer Light { MirrorLight data[]; } light;
// Next paths, surfels, and rays by how they ended: on triangles, on cells of grids, as cones, nowhere.
buffer Counts { uint next, surfels, triangles, cells, wide, missed; } counts;
layout(push_constant, scalar) uniform Push {
    MirrorBatch batch;
    uint count;
    uint depth;   // Reflections before these rays, minus one.
    uint isLast;  // 1: no next rays.
} push;

// Emission after one reflection is direct light, as in the reference.
void addEmitted(MirrorPath path, vec3 radiance) {
    if (path.countsEmission == 0u) return;
    if (push.depth == 0u) light.data[path.index].direct += path.throughput * radiance;
    else light.data[path.index].indirect += path.throughput * radiance;
}

// Records where the first ray of a path ended.
void recordEnd(MirrorPath path, uint end) {
    if (push.depth == 0u) light.data[path.index].end = end;
}

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const MirrorPath path = paths.data[i];
    const Ray ray = rays.data[i];
    const Hit hit = hits.data[i];
    if (ray.tMax < ray.tMin) return;
    if (hit.triangle == NO_HIT) {
        atomicAdd(counts.missed, 1u);
        recordEnd(path, ENDS_NOWHERE);
        addEmitted(path, environmentRadiance(ray.direction));
        return;
    }
#ifdef HYBRID
    if (hit.triangle == HIT_IS_WIDE) {  // trace_cone_continuation.comp
        atomicAdd(counts.wide, 1u);
        recordEnd(path, ENDS_AS_CONE);
        return;
    }
#endif
    const float width = abs(path.width + path.spread * hit.t);
    HitSurface surface;
    float clearance = 0.0;  // m: minimum offset of shadow rays.
#ifdef HYBRID
    if (isCell(hit)) {
        atomicAdd(counts.cells, 1u);
        recordEnd(path, ENDS_ON_CELL);
        surfaceOfCell(hit, ray, surface);
        clearance = hit.u;  // The cell's edge.
    } else
#endif
    {
        atomicAdd(counts.triangles, 1u);
        recordEnd(path, ENDS_ON_TRIANGLE);
        if (!surfaceAtHit(hit, ray.direction, width * width, surface)) return;
    }
    addEmitted(path, surface.emission);

    // Diffuse lobe: indirect light from voxels; direct light is measured at a surfel
    const vec3 out_ = -ray.direction, n = specularNormal(surface.normal, out_);
    const float cosOut = dot(n, out_);
    const float weight = hasSpecular(surface.specular) ? rayWeight(push.batch, surface.specular.roughness) : 0.0;
    const vec3 diffuse =
        path.throughput * surface.albedo * (mix(1.0, meanDiffuseFraction(surface.specular, cosOut), weight) / PI);
    const uint id = (push.batch.firstPixel * texelsPerPixel(push.batch)) * push.batch.rays + path.index;
    if (any(greaterThan(diffuse, vec3(0.0)))) {
        bool isKnown;
        light.data[path.index].indirect +=
            diffuse * interpolatedIrradianceAt(grid.data, surface.position, surface.faceNormal, isKnown);
        if (kShadowRays)
            surfels.data[atomicAdd(counts.surfels, 1u)] =
                Surfel(surface.position + max(clearance, surface.offset) * surface.faceNormal, NO_VOXEL, surface.normal,
                       id, diffuse, path.index, 1.0);
    }

    // The next ray, at a hit on a mirror
    if (push.isLast != 0u || weight == 0.0) return;
    const LobeRay lobe = lobeRay(surface.specular, n, surface.faceNormal, out_,
                                 sobol2(id, push.batch.seed + 0x51u * (push.depth + 1u)), 1u);
    const vec3 throughput = path.throughput * weight * lobe.weight;
    if (all(equal(throughput, vec3(0.0)))) return;
    const uint next = atomicAdd(counts.next, 1u);
    const float spread = sqrt(path.spread * path.spread + lobe.solidAngle);
    nextPaths.data[next] = MirrorPath(throughput, path.index, width, spread, 1u);
    nextRays.data[next] = Ray(surface.position + surface.faceNormal * surface.offset, 0.0, lobe.direction, 1.0e30);
#ifdef HYBRID
    nextStarts.data[next] = RayStart(surface.faceNormal, width, spread);
#endif
}
