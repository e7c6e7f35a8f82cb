// What a ray that gathers light finds at its hit. Needs the bindings of shaders/scene/scene.glsl.
#ifndef VOXRAY_FINAL_GATHER_HIT_GLSL
#define VOXRAY_FINAL_GATHER_HIT_GLSL

#include "passes/final_gather/gather_rays/stored_light.glsl"
#include "passes/surfels/surfel_at_hit.glsl"
#include "shaders/scene/octahedral.glsl"

layout(scalar) buffer Light { vec4 data[]; } light;
// The hits where direct light is to be measured, in any order; `parent` is the ray.
layout(scalar) writeonly buffer Surfels { Surfel data[]; } surfels;
// By surfel: 1 where its ray goes on from there, and the geometric normal, octahedral.
layout(scalar) writeonly buffer Continuations { uvec2 data[]; } continuations;
buffer Counts {
    uint surfels;
    uint unlit;  // Hits far enough off to read what is stored there, where nothing is.
} counts;

// The end of ray i, which comes from `from` and brings `throughput` of what the surface at its hit reflects. A cell cannot tell
// points apart that are closer to each other than its size: a ray that is shorter than `nearField` cells does not read it but goes on
// from its hit, as a path does. So does one that hit where no light is stored. With a `nearField` of 0 all rays end.
//
//      ┌───────┬───────┐
//      │   o───┼───┼─> ·   ·: a hit further off than a cell is read.
//      │    \  │       │   x: one nearer is not; there a shadow ray measures direct light, and a ray goes on.
//     ─┼─────x─┼───────┼─
//      └───────┴───────┘
void shadeHit(uint i, Hit hit, vec3 from, vec3 throughput, uint id, float nearField) {
    Surfel at;
    vec3 faceNormal;
    float offset;
    if (!surfelAtHit(hit, from, at, faceNormal, offset)) return;

    // What is stored there, of the side that the ray came from.
    at.reflectance *= throughput;
    const StoredLight stored = storedLight(at.position, faceNormal);
    const bool isNear = hit.t < nearField * stored.cellSize;
    if (!isNear && !stored.known) atomicAdd(counts.unlit, 1u);
    const bool isContinued = isNear || (nearField > 0.0 && !stored.known);
    if (!isContinued) light.data[i].rgb += at.reflectance * stored.irradiance;
#ifndef SHADOW_RAYS
    if (!isContinued) return;
#endif

    // Where light is measured.
    at.position += offset * faceNormal;
    at.id = id;
    at.parent = i;
    const uint number = atomicAdd(counts.surfels, 1u);
    surfels.data[number] = at;
    continuations.data[number] = uvec2(isContinued ? 1u : 0u, toOctahedral(faceNormal));
}

#endif
