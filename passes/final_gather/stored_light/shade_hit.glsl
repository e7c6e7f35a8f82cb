// Shading of a gather ray's hit by stored light. Needs the bindings of shaders/scene/scene.glsl.
#ifndef VOXRAY_SHADE_HIT_GLSL
#define VOXRAY_SHADE_HIT_GLSL

#include "passes/final_gather/stored_light/stored_light.glsl"
#include "passes/surfels/mirror_at_hit.glsl"
#include "shaders/scene/octahedral.glsl"

layout(scalar) buffer Light { vec4 data[]; } light;
// Hits where shadow rays measure direct light, in any order; `parent` is the gather ray.
layout(scalar) writeonly buffer Surfels { Surfel data[]; } surfels;
// Per surfel: 1 where its path continues, and the geometric normal, octahedral.
layout(scalar) writeonly buffer Continuations { uvec2 data[]; } continuations;
buffer Counts {
    uint surfels;
    uint continued;  // Of them, those whose paths continue.
    uint unlit;  // Hits beyond the near field where no light is stored.
    uint traced;  // Rays of paths that continued before.
} counts;

#define ANY_DISTANCE 1.0e30  // m

// Lists a hit where shadow rays measure direct light, or where a mirror reflects.
void listHit(Surfel surfel, vec3 faceNormal, bool isContinued) {
    const uint index = atomicAdd(counts.surfels, 1u);
    if (isContinued) atomicAdd(counts.continued, 1u);
    surfels.data[index] = surfel;
    continuations.data[index] = uvec2(isContinued ? 1u : 0u, toOctahedral(faceNormal));
}

// Adds `throughput` times the light reflected at a ray's hit to gather ray i. Stored light has the resolution of its
// cells: a ray from `origin` that is shorter than `nearField` cells does not read it but continues as a path does, and
// so does a ray that hits where no light is stored, or a perfect mirror. With a `nearField` of 0 every ray ends at its
// hit. Returns the distance within which rays to this point continue, m.
//
//      ┌───────┬───────┐
//      │   o───┼───┼─> ·   ·: a hit beyond the near field reads the cell.
//      │    \  │       │   x: at a hit in the near field a shadow ray measures direct light, and the path continues.
//     ─┼─────x─┼───────┼─
//      └───────┴───────┘
float shadeHit(uint i, Hit hit, vec3 origin, vec3 throughput, uint id, float nearField) {
    Surfel surfel;
    vec3 faceNormal;
    float offset;
    if (!surfelAtHit(hit, origin, surfel, faceNormal, offset)) return 0.0;
    const vec3 position = surfel.position;
    const bool isMirror = nearField > 0.0 && reflectAtMirror(hit, origin, faceNormal, surfel);
    surfel.position += offset * faceNormal;
    surfel.reflectance *= throughput;
    surfel.id = id;
    surfel.parent = i;
    if (isMirror) {
        listHit(surfel, faceNormal, true);
        return ANY_DISTANCE;
    }

    // Read the light stored for the side that the ray hit
    const StoredLight stored = storedLight(position, faceNormal);
    const float nearDistance = nearField * stored.cellSize;
    const bool isNear = hit.t < nearDistance;
    if (!isNear && !stored.known) atomicAdd(counts.unlit, 1u);
    const bool isContinued = isNear || (nearField > 0.0 && !stored.known);
    if (!isContinued) light.data[i].rgb += surfel.reflectance * stored.irradiance;
#ifndef SHADOW_RAYS
    if (!isContinued) return nearDistance;
#endif
    listHit(surfel, faceNormal, isContinued);
    return nearDistance;
}

#endif
