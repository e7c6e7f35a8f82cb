// A vertex of paths: adds light that their rays hit, samples a light, and scatters. Lists the rays to sampled lights and
// those of paths that go on, each packed: a work group takes its places in both lists at once.
#include "path_batch.glsl"
#include "path_lights.glsl"
#include "path_surface.glsl"
#include "shaders/trace/stream_count.h"
layout(local_size_x = 64) in;  // STREAM_GROUP

layout(constant_id = 0) const uint kBounces = 8;
layout(constant_id = 1) const bool kHasDirectLight = true;  // Emission and direct light at the first hit count.
layout(constant_id = 2) const bool kNeedsIrradiance = false;

layout(scalar) readonly buffer Rays { Ray data[]; } rays;
layout(scalar) readonly buffer Hits { Hit data[]; } hits;
layout(scalar) readonly buffer Vertices { PathVertex data[]; } vertices;
layout(scalar) writeonly buffer NextRays { Ray data[]; } nextRays;
layout(scalar) writeonly buffer NextVertices { PathVertex data[]; } nextVertices;
layout(scalar) writeonly buffer ShadowRays { Ray data[]; } shadowRays;
layout(scalar) writeonly buffer ShadowLights { LightAlongRay data[]; } shadowLights;
#ifdef PANES
layout(scalar) writeonly buffer HitRays { Ray data[]; } hitRays;
layout(scalar) writeonly buffer HitLights { LightAlongRay data[]; } hitLights;
#endif
layout(scalar) buffer Sums { PathSums data[]; } sums;
layout(scalar) buffer Counts { StreamCount data[]; } counts;
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Facts { uint data[]; };
layout(push_constant, scalar) uniform Push {
    PathBatch batch;
    PathLights lights;
    uint64_t triangleFacts;  // uint a triangle: its patch, IS_SIMPLE.
    uint vertex;               // 0: what the camera sees.
} push;

// Sobol pairs of each vertex; the camera uses pair 0.
#define PAIR_LIGHT_POINT 1u
#define PAIR_LIGHT_CHOICE 2u
#define PAIR_REFLECTION 3u
#define PAIR_LOBE 4u
#define PAIR_ROULETTE 5u
#define PAIRS 8u
// Vertices before Russian roulette.
#define MIN_ROULETTE_VERTICES 3u
// Shadow rays end at this fraction of the distance to the light.
#define SHADOW_END (1.0 - 4e-6)

PathVertex path;
Ray ray, nextRay = kNoRay, shadowRay = kNoRay;
PathVertex next;
vec3 light = vec3(0.0), hitLight = vec3(0.0);  // Along the shadow ray, and of what the ray hit.
float hitDistance;

uint pairOf(uint pair) { return push.vertex * PAIRS + pair; }
bool isSeenDirectly() { return path.bsdfPdf < 0.0; }

// What lights were sampled for where the ray left.
LightReceiver receiver() { return LightReceiver(ray.origin, path.faceNormal); }

// Weight of a patch that the ray hits; `cosine`: of its direction and the normal.
float patchWeight(uint patch_, float cosine) {
    if (isSeenDirectly()) return 1.0;
    return misWeight(path.bsdfPdf, patchPdf(push.lights, patch_, cosine, hitDistance, receiver()));
}

float environmentWeight() {
    return isSeenDirectly() ? 1.0 : misWeight(path.bsdfPdf, environmentPdf(push.lights, ray.direction, receiver()));
}

void addHitLight() {
    if (push.vertex <= 1u) {
        sums.data[path.slot].direct += path.throughput * hitLight;
        return;
    }
    sums.data[path.slot].indirect += path.throughput * hitLight;
    if (kNeedsIrradiance) sums.data[path.slot].irradiance += path.irradianceThroughput * hitLight;
}

void sampleDirectLight(PathSurface p, SobolSampler s) {
    const float uLight = push.lights.isSingle != 0u ? 0.0 : sobol1D(s, pairOf(PAIR_LIGHT_CHOICE));
    const LightSample sampled =
        sampleLight(push.lights, uLight, sobol2D(s, pairOf(PAIR_LIGHT_POINT)), LightReceiver(p.origin, p.faceNormal));
    if (!(sampled.pdf > 0.0) || !(dot(sampled.direction, p.faceNormal) > 0.0)) return;
    const BsdfValue value = bsdfValue(p.bsdf, -ray.direction, sampled.direction, p.shadingNormal);
    light = value.fCos * sampled.radiance / sampled.pdf;
    if (!sampled.isDelta) light *= misWeight(sampled.pdf, value.pdf);
    if (largestComponent(light) > 0.0)
        shadowRay = Ray(p.origin, 0.0, sampled.toLight, sampled.isInfinite ? 1.0e30 : SHADOW_END);
}

void scatter(PathSurface p, SobolSampler s) {
    if (push.vertex == kBounces && push.lights.canBeHit == 0u) return;
    const float uLobe = hasSpecular(p.bsdf.specular) ? sobol1D(s, pairOf(PAIR_LOBE)) : 0.0;
    const BsdfSample sampled =
        bsdfSample(p.bsdf, -ray.direction, p.shadingNormal, sobol2D(s, pairOf(PAIR_REFLECTION)), uLobe);
    next = PathVertex(path.throughput * sampled.weight, sampled.pdf, path.irradianceThroughput * sampled.weight,
                      path.slot, p.faceNormal);
    if (push.vertex == 0u && sampled.pdf > 0.0)
        next.irradianceThroughput = vec3(dot(p.shadingNormal, sampled.direction) / sampled.pdf);

    // Directions below the surface are absorbed
    const float throughput = largestComponent(next.throughput);
    if (!(throughput > 0.0) || !(dot(sampled.direction, p.faceNormal) > 0.0)) return;

    // Russian roulette by the square root of the throughput: shorter paths, more noise, the same mean
    if (push.vertex + 1u >= MIN_ROULETTE_VERTICES && throughput < 1.0) {
        const float survival = sqrt(throughput);
        if (sobol1D(s, pairOf(PAIR_ROULETTE)) >= survival) return;
        next.throughput /= survival;
        next.irradianceThroughput /= survival;
    }
    nextRay = Ray(p.origin, 0.0, sampled.direction, 1.0e30);
}

// Shades a path's vertex: sets `hitLight`, `light`, `shadowRay`, `nextRay` and `next`.
void shade(Hit hit) {
    const bool countsHitLight = push.vertex > 1u || kHasDirectLight;
    hitDistance = hit.t;
    if (hit.triangle == NO_HIT) {
        if (countsHitLight)
            hitLight = environmentRadiance(ray.direction) * environmentWeight();
        return;
    }
    if (push.vertex == 1u) sums.data[path.slot].distance_ = hit.t;
    const uint facts = Facts(push.triangleFacts).data[hit.triangle], patch_ = facts & PATCH_BITS;
    if (push.vertex > kBounces && patch_ == NO_PATCH) return;
    const vec2 barycentrics = vec2(hit.u, hit.v);
    SurfacePoint s;
    if ((facts & IS_SIMPLE) != 0u) s = simplePoint(hit.triangle, barycentrics);
    else s = surfacePoint(hit.triangle, barycentrics);
    const GpuMaterial m = sceneMaterials.data[s.material];
    const float cosine = -dot(s.geometricNormal, ray.direction);
    if (countsHitLight && patch_ != NO_PATCH && (m.doubleSided != 0u || cosine > 0.0))
        hitLight = emission(m, s, 0.0) * patchWeight(patch_, cosine);
    if (push.vertex > kBounces) return;

    const PathSurface p = pathSurface(s, m, ray.direction);
    const uvec2 pixel = pixelOf(push.batch, path.slot / push.batch.samples);
    const SobolSampler random = samplerOf(push.batch, pixel, path.slot % push.batch.samples);
    if (push.vertex == 0u && largestComponent(p.bsdf.diffuse) > 0.0) sums.data[path.slot].hasIrradiance = 1u;
    if (push.lights.treeNodes + push.lights.infiniteLights > 0u && (push.vertex > 0u || kHasDirectLight))
        sampleDirectLight(p, random);
    scatter(p, random);
}

shared uint places[STREAMS];
shared uint firstPlaces[STREAMS];

// The list of each stream: the rays of the next vertex are the only ones that belong to another one.
uint streamIndex(uint stream) { return STREAMS * (push.vertex + (stream == STREAM_RAYS ? 1u : 0u)) + stream; }

// Reserves a work group's places in the lists.
void reserve() {
    const uint stream = gl_LocalInvocationIndex;
    if (stream >= STREAMS || places[stream] == 0u) return;
    const uint index = streamIndex(stream), count = places[stream], first = atomicAdd(counts.data[index].count, count);
    firstPlaces[stream] = first;
    const uint before = (first + STREAM_GROUP - 1u) / STREAM_GROUP;
    atomicAdd(counts.data[index].groups, (first + count + STREAM_GROUP - 1u) / STREAM_GROUP - before);
}

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (gl_LocalInvocationIndex < STREAMS) places[gl_LocalInvocationIndex] = 0u;
    barrier();
    if (i < counts.data[STREAMS * push.vertex + STREAM_RAYS].count) {
        ray = rays.data[i];
        path = vertices.data[i];
        if (ray.tMax >= ray.tMin) shade(hits.data[i]);
    }

    uint place[STREAMS];
    const bool isLit = shadowRay.tMax >= 0.0, goesOn = nextRay.tMax >= 0.0;
    bool hitsLight = largestComponent(hitLight) > 0.0;
#ifdef PANES
    const bool crossesPanes = hitsLight && !isSeenDirectly();
    if (crossesPanes) place[STREAM_HIT_LIGHTS] = atomicAdd(places[STREAM_HIT_LIGHTS], 1u);
    hitsLight = hitsLight && !crossesPanes;
#endif
    if (hitsLight) addHitLight();
    if (isLit) place[STREAM_SHADOW_RAYS] = atomicAdd(places[STREAM_SHADOW_RAYS], 1u);
    if (goesOn) place[STREAM_RAYS] = atomicAdd(places[STREAM_RAYS], 1u);
    barrier();
    reserve();
    barrier();
    if (isLit) {
        const uint to = firstPlaces[STREAM_SHADOW_RAYS] + place[STREAM_SHADOW_RAYS];
        shadowRays.data[to] = shadowRay;
        shadowLights.data[to] = LightAlongRay(light, path.slot, path.throughput, path.irradianceThroughput);
    }
    if (goesOn) {
        const uint to = firstPlaces[STREAM_RAYS] + place[STREAM_RAYS];
        nextRays.data[to] = nextRay;
        nextVertices.data[to] = next;
    }
#ifdef PANES
    if (crossesPanes) {
        const uint to = firstPlaces[STREAM_HIT_LIGHTS] + place[STREAM_HIT_LIGHTS];
        hitRays.data[to] = Ray(ray.origin, ray.tMin, ray.direction, hitDistance);
        hitLights.data[to] = LightAlongRay(hitLight, path.slot, path.throughput, path.irradianceThroughput);
    }
#endif
}
