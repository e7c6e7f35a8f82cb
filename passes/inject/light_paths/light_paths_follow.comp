// Leaves what each ray carries in the voxel that it hit, then turns it into its next bounce.
#include "shaders/compute/linear_index.glsl"
#include "passes/inject/light_paths/material_bounce.glsl"
#include "shaders/voxels/voxels.glsl"
#ifdef FLUX
#include "shaders/voxels/flux_accumulator.glsl"
#else
#include "shaders/voxels/voxel_accumulator.glsl"
#endif
layout(local_size_x = 64) in;

layout(constant_id = 0) const uint kSecondary = SECONDARY_DIFFUSE;
layout(constant_id = 1) const bool kCaustics = true;  // Mirrors send on what comes straight from a punctual light.

layout(scalar) buffer Rays { Ray data[]; } rays;
layout(scalar) buffer Paths { LightPath data[]; } paths;
layout(scalar) readonly buffer Hits { Hit data[]; } hits;
readonly buffer Hidden { uint data[]; } hidden;
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint firstRay;
    uint batchRays;
    uint seed;
    uint bounce;
    uint lastBounce;
    float scale;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.batchRays) return;
    Ray ray = rays.data[i];
    if (ray.tMax < ray.tMin) return;
    const Hit hit = hits.data[i];
    rays.data[i].tMax = -1.0;
    if (hit.triangle == NO_HIT) return;

    // Deposit on the side that the ray came from, if open space lies before it, as voxelization counts its area.
    const SurfacePoint s = surfacePoint(hit.triangle, vec2(hit.u, hit.v));
    if (dot(s.geometricNormal, s.geometricNormal) == 0.0) return;
    const LightVertex lit = lightVertex(s, ray.direction);
    LightPath path = paths.data[i];
    path.travelled += hit.t;
    if (hidden.data[i] == 0u) {
        const uint voxel = nearestVoxel(push.grid, s.position);
        if (voxel != NO_VOXEL) {
#ifdef FLUX
            addFlux(voxel, lit.faceNormal, path.power, push.scale);
#else
            // Irradiance: the beam's power over its cross-section, times the cosine.
            const float crossSection = path.area + path.solidAngle * path.travelled * path.travelled;
            const vec3 irradiance = path.power * (-dot(lit.faceNormal, ray.direction) / max(crossSection, 1e-20));
            writeIrradiance(voxel, lit.faceNormal, irradiance, 1.0, push.scale);
#endif
        }
    }
    if (push.bounce == push.lastBounce) return;

    const uint seed = hashCombine(push.seed, 16u + 2u * push.bounce);
    const bool goesOn = kSecondary == SECONDARY_MATERIAL
                            ? bounceByMaterial(s, lit, kCaustics || push.bounce > 0u || !isBeam(path), push.firstRay + i, seed, ray, path)
                            : bounceLightRay(lit, kSecondary == SECONDARY_MIRROR, push.firstRay + i, seed, ray, path);
    if (!goesOn) return;
    paths.data[i] = path;
    rays.data[i] = ray;
}
