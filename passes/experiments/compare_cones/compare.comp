// Compares each cone of a batch with the exact ray along its axis, over the same voxels.
#define CONE_RECORDS
#include "passes/cones/radiance/cone_ray_batch.glsl"
#include "passes/cones/radiance/cone_types.h"
#include "passes/cones/radiance/radiance_at_hit.glsl"
#include "passes/cones/radiance/radiance_cone.glsl"
#include "passes/surfels/surfel_at_hit.glsl"
#include "cone_record.h"
layout(local_size_x = 64) in;

uniform sampler2D albedo;
layout(scalar) readonly buffer Cones { Cone data[]; } cones;
layout(scalar) readonly buffer Rays { Ray data[]; } rays;
layout(scalar) readonly buffer Hits { Hit data[]; } hits;
layout(scalar) writeonly buffer Records { float data[]; } records;

// Near: within so many of the finest voxels.
const float kNearVoxels = 2.0;
const float kMiss = 1.0e30;

float record[RECORDED_NUMBERS];
float rayLength;  // m to the hit, or kMiss.
float conePart;   // Of the cone's light that counts: its weight.
vec3 reflected;   // The same by color: albedo and luminance.

float light(vec3 radiance) { return dot(reflected, radiance); }

void recordCone(vec3 radiance, float opacity, float t, uint level) {
    const float around = kNearVoxels * radianceVoxelSize(level);
    int part = CONE_MISSED;
    if (rayLength < kMiss) {
        part = t < rayLength - around ? CONE_BEFORE : t <= rayLength + around ? CONE_AT_HIT : CONE_BEHIND;
        if (part == CONE_BEFORE) record[OPACITY_BEFORE] += conePart * opacity;
        if (part != CONE_BEHIND) record[OPACITY_BEHIND] -= conePart * opacity;
        if (part == CONE_BEFORE && t < kNearVoxels * radianceVoxelSize(0u)) part = CONE_START;
    }
    record[part] += light(radiance);
    record[CONE_LEVEL + min(int(level), RECORDED_LEVELS - 1)] += light(radiance);
}

// The level of the voxels as wide as a cone at `distance_` metres from its start: at most half as wide, as in
// radiance_cone.glsl, and not finer than the layout has them there.
uint levelOfCone(vec3 position, float width, float distance_, vec2 dither) {
    const RadianceGrid g = radianceVoxels.grid;
    const float level = log2(max(0.5 * width * distance_ / g.voxelSize, 1e-6)) + dither.y - 0.5;
    return max(uint(clamp(level, 0.0, float(g.levels - 1u))), startLevel(position, dither.x));
}

void recordRay(Ray ray, Hit hit, float width, vec2 dither) {
    Surfel surfel;
    vec3 normal;
    float offset;
    if (!surfelAtHit(hit, ray.origin, surfel, normal, offset)) return;
    rayLength = hit.t;
    record[WEIGHT_OF_HITS] = record[OPACITY_BEHIND] = conePart;
    const uint finest = startLevel(surfel.position, dither.x);
    const bool isNear = hit.t < kNearVoxels * radianceVoxelSize(0u);
    record[isNear ? RAY_NEAR : RAY_FAR] = light(radianceAtHit(surfel.position, normal, finest));
    record[RAY_CONE] =
        light(radianceAtHit(surfel.position, normal, levelOfCone(surfel.position, width, hit.t, dither)));
    for (uint level = 0u; level < RECORDED_LEVELS; ++level)
        record[RAY_LEVEL + level] = light(radianceAtHit(
            surfel.position, normal, clamp(level, finest, max(finest, radianceVoxels.grid.levels - 1u))));
}

void main() {
    const uint i = linearIndex();
    if (i >= push.batchCones) return;
    for (int k = 0; k < RECORDED_NUMBERS; ++k) record[k] = 0.0;
    const Ray ray = rays.data[i];
    if (ray.tMax >= 0.0) {
        const ivec2 texel = texelOfCone(i);
        const vec3 ng = normalize(texelFetch(geometricNormal, texel, 0).xyz);
        const Cone cone = cones.data[i % push.conesPerTexel];
        const float dither = texelDither(texel).z;
        conePart = cone.weight;
        reflected = cone.weight * texelFetch(albedo, texel, 0).rgb * vec3(0.2126, 0.7152, 0.0722);
        rayLength = kMiss;
        recordRay(ray, hits.data[i], cone.width, vec2(dither));
        coneRadiance(coneBase(texelFetch(position, texel, 0).xyz, ng, dither, 0.0), ray.direction, cone.width,
                     dither - 0.5);
    }
    for (int k = 0; k < RECORDED_NUMBERS; ++k) records.data[RECORDED_NUMBERS * i + k] = record[k];
}
