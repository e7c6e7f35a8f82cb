// The ends of rays: what they bring of emitted and of reflected light, and the rays that mirrors among them send on.
#include "passes/hybrid_leaves/gather_mirror/batch.glsl"
#include "passes/hybrid_leaves/gather_mirror/diffuse_fraction.glsl"
#include "shaders/scene/lobe_ray.glsl"
#include "passes/hybrid_leaves/gather_mirror/surface.glsl"
#include "passes/surfels/surfel_types.h"
#include "shaders/voxels/face_irradiance.glsl"
layout(local_size_x = 64) in;
layout(constant_id = 0) const bool kShadowRays = false;  // Voxels hold indirect light alone; direct light is measured.

layout(scalar) readonly buffer Grid { VoxelGrid data; } grid;
layout(scalar) readonly buffer Paths { MirrorPath data[]; } paths;
layout(scalar) readonly buffer Rays { Ray data[]; } rays;
layout(scalar) readonly buffer Hits { Hit data[]; } hits;
layout(scalar) writeonly buffer NextPaths { MirrorPath data[]; } nextPaths;
layout(scalar) writeonly buffer NextRays { Ray data[]; } nextRays;
#ifdef HYBRID
layout(scalar) writeonly buffer NextStarts { RayStart data[]; } nextStarts;
#endif
layout(scalar) writeonly buffer Surfels { Surfel data[]; } surfels;  // Where direct light is measured; `parent` is the slot.
layout(scalar) buffer Light { MirrorLight data[]; } light;
// Of next paths, of surfels, of rays that hit triangles, of those that hit cells of grids, of those that went on as cones, and of
// those that missed.
buffer Counts { uint next, surfels, triangles, cells, wide, missed; } counts;
layout(push_constant, scalar) uniform Push {
    MirrorBatch batch;
    uint count;
    uint depth;   // Reflections before these rays, less one.
    uint isLast;  // 1: mirrors send nothing on.
} push;

// Emitted light by one reflection is direct light, as in the reference.
void addEmitted(MirrorPath path, vec3 radiance) {
    if (path.seesLamps == 0u) return;
    if (push.depth == 0u) light.data[path.slot].direct += path.throughput * radiance;
    else light.data[path.slot].indirect += path.throughput * radiance;
}

// What a ray from the camera's mirror ended on.
void noteEnd(MirrorPath path, uint end) {
    if (push.depth == 0u) light.data[path.slot].end = end;
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
        noteEnd(path, ENDS_NOWHERE);
        addEmitted(path, environmentRadiance(ray.direction));
        return;
    }
#ifdef HYBRID
    if (hit.triangle == HIT_IS_WIDE) {  // wide.comp
        atomicAdd(counts.wide, 1u);
        noteEnd(path, ENDS_AS_CONE);
        return;
    }
#endif
    const float width = abs(path.width + path.spread * hit.t);
    MirrorSurface at;
    float clearance = 0.0;  // m: shadow rays start so far off the surface.
#ifdef HYBRID
    if (isCell(hit)) {
        atomicAdd(counts.cells, 1u);
        noteEnd(path, ENDS_ON_CELL);
        surfaceOfCell(hit, ray, at);
        clearance = hit.u;  // The cell's edge.
    } else
#endif
    {
        atomicAdd(counts.triangles, 1u);
        noteEnd(path, ENDS_ON_TRIANGLE);
        if (!surfaceAtHit(hit, ray.direction, width * width, at)) return;
    }
    addEmitted(path, at.emission);

    // What the diffuse lobe reflects of the light in voxels, and of what shadow rays bring.
    const vec3 out_ = -ray.direction, n = specularNormal(at.normal, out_);
    const float cosOut = dot(n, out_);
    const float weight = hasSpecular(at.specular) ? rayWeight(push.batch, at.specular.roughness) : 0.0;
    const vec3 diffuse = path.throughput * at.albedo * (mix(1.0, meanDiffuseFraction(at.specular, cosOut), weight) / PI);
    const uint id = (push.batch.firstPixel * texelsPerPixel(push.batch)) * push.batch.rays + path.slot;
    if (any(greaterThan(diffuse, vec3(0.0)))) {
        bool isKnown;
        light.data[path.slot].indirect += diffuse * interpolatedIrradianceAt(grid.data, at.position, at.faceNormal, isKnown);
        if (kShadowRays)
            surfels.data[atomicAdd(counts.surfels, 1u)] =
                Surfel(at.position + max(clearance, at.offset) * at.faceNormal, NO_VOXEL, at.normal, id, diffuse, path.slot, 1.0);
    }

    // A mirror in a mirror.
    if (push.isLast != 0u || weight == 0.0) return;
    const LobeRay on = lobeRay(at.specular, n, at.faceNormal, out_, sobol2(id, push.batch.seed + 0x51u * (push.depth + 1u)), 1u);
    const vec3 throughput = path.throughput * weight * on.weight;
    if (all(equal(throughput, vec3(0.0)))) return;
    const uint next = atomicAdd(counts.next, 1u);
    const float spread = sqrt(path.spread * path.spread + on.solidAngle);
    nextPaths.data[next] = MirrorPath(throughput, path.slot, width, spread, 1u);
    nextRays.data[next] = Ray(at.position + at.faceNormal * at.offset, 0.0, on.direction, 1.0e30);
#ifdef HYBRID
    nextStarts.data[next] = RayStart(at.faceNormal, width, spread);
#endif
}
