// Radiance of the indirect light that comes to a probe along each of its rays: what the surface at the hit reflects of
// stored light. The environment and emission are direct light, so rays that miss bring none. Source: Majercik et al.
// 2019, section 4.
#include "shaders/compute/linear_index.glsl"
#include "passes/probes/update_probes/hits_from_behind.glsl"
#include "passes/surfels/surfel_at_hit.glsl"
#include "shaders/scene/sampling.glsl"
#ifdef FROM_VOXELS
#include "passes/probes/probe_grid.glsl"
#include "shaders/voxels/face_irradiance.glsl"
#include "shaders/voxels/voxel_levels.glsl"
#else
#include "passes/probes/probe_lookup.glsl"
// For shadow rays; without a normal where there is no light to be found.
layout(scalar) writeonly buffer Surfels { Surfel data[]; } surfels;
#endif
layout(local_size_x = 64) in;

readonly buffer List { uint data[]; } list;
layout(scalar) readonly buffer Rays { Ray data[]; } rays;
layout(scalar) readonly buffer Hits { Hit data[]; } hits;
// Radiance, W/(m² sr), and the distance of the surface in smallest spacings, negative where it was hit from behind.
layout(scalar) writeonly buffer Light { vec4 data[]; } light;
layout(push_constant) uniform Push {
    uint first;  // Of the batch, in the list.
    uint rayCount;
    uint raysPerProbe;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.rayCount) return;
    const uint probe = list.data[push.first + i / push.raysPerProbe];
    const Hit hit = hits.data[i];
    const Ray ray = rays.data[i];
    const bool isMiss = hit.triangle == NO_HIT;
    // Surfaces beyond one and a half diagonals of a cell are beyond all that is lit from a probe
    const ProbeGrid g = probeGrids.data[probePlace(probe).cascade];
    const float farthest = 1.5 * length(g.spacing), distance_ = (isMiss ? farthest : min(hit.t, farthest)) / g.minSpacing;
    const bool isBehind = !isMiss && hitsFromBehind(hit, ray.direction);

    Surfel s = Surfel(vec3(0.0), NO_VOXEL, vec3(0.0), i, vec3(0.0), i, 1.0);
    vec3 faceNormal, radiance = vec3(0.0);
    float offset;
    if (!isBehind && surfelAtHit(hit, ray.origin, s, faceNormal, offset)) {
#ifdef FROM_VOXELS
        bool known;
        const vec3 irradiance = irradianceAt(gridAt(s.position), s.position, faceNormal, known);
#else
        float known;
        const vec3 irradiance = probeIrradianceAt(s.position, s.normal, -ray.direction, known);
        s.position += offset * faceNormal;
        s.id = push.first * push.raysPerProbe + i;
        s.parent = i;
#endif
        radiance = s.reflectance / PI * irradiance;
    }
#ifndef FROM_VOXELS
    surfels.data[i] = s;
#endif
    light.data[i] = vec4(radiance, isBehind ? -max(distance_, 1e-6) : distance_);
}
