// Deposits the light of each ray in the voxel at its hit, then scatters the ray. VOXEL_LEVELS: the voxels are those of
// several levels.
#include "shaders/compute/linear_index.glsl"
#include "passes/inject/light_paths/material_bounce.glsl"
#ifdef VOXEL_LEVELS
#include "shaders/voxels/voxel_levels.glsl"
#else
#include "shaders/voxels/voxels.glsl"
#endif
#ifdef FLUX
#include "shaders/voxels/flux_accumulator.glsl"
#else
#include "shaders/voxels/voxel_accumulator.glsl"
#endif
layout(local_size_x = 64) in;

layout(constant_id = 0) const uint kSecondary = SECONDARY_DIFFUSE;
layout(constant_id = 1) const bool kCaustics = true;  // Whether perfect mirrors reflect rays of punctual lights.

layout(scalar) buffer Rays { Ray data[]; } rays;
layout(scalar) buffer Paths { LightPath data[]; } paths;
layout(scalar) readonly buffer Hits { Hit data[]; } hits;
readonly buffer Occluded { uint data[]; } occluded;  // Of hits.
layout(push_constant, scalar) uniform Push {
#ifndef VOXEL_LEVELS
    VoxelGrid grid;  // In push constants: looked up by position it makes the injection 5 % slower.
#endif
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

    // Deposit on the side that the ray came from, unless it is occluded: then voxelization does not count its area
    const SurfacePoint s = surfacePoint(hit.triangle, vec2(hit.u, hit.v));
    if (dot(s.geometricNormal, s.geometricNormal) == 0.0) return;
    const LightVertex v = lightVertex(s, ray.direction);
    LightPath path = paths.data[i];
    path.travelled += hit.t;
    if (occluded.data[i] == 0u) {
#ifdef VOXEL_LEVELS
        const VoxelGrid grid = gridAt(s.position);
#else
        const VoxelGrid grid = push.grid;
#endif
        const uint voxel = nearestVoxel(grid, s.position);
        if (voxel != NO_VOXEL) {
#ifdef FLUX
            addFlux(voxel, v.faceNormal, path.power, push.scale);
#else
            // Irradiance: the beam's power over its cross-section, times the cosine
            const float crossSection = path.area + path.solidAngle * path.travelled * path.travelled;
            const vec3 irradiance = path.power * (-dot(v.faceNormal, ray.direction) / max(crossSection, 1e-20));
            writeIrradiance(voxel, v.faceNormal, irradiance, 1.0, push.scale);
#endif
        }
    }
    if (push.bounce == push.lastBounce) return;

    const uint seed = hashCombine(push.seed, 16u + 2u * push.bounce);
    const bool mirrors = kCaustics || push.bounce > 0u || !isBeam(path);
    const bool survives = kSecondary == SECONDARY_MATERIAL
                              ? bounceByMaterial(s, v, mirrors, push.firstRay + i, seed, ray, path)
                              : bounceLightRay(v, kSecondary == SECONDARY_MIRROR, push.firstRay + i, seed, ray, path);
    if (!survives) return;
    paths.data[i] = path;
    rays.data[i] = ray;
}
