// Resolves the ray along a cone's axis. With NEAR_FIELD a hit within the near field is stored as a surfel, where direct
// light is sampled and a path continues. Beyond it the cone is traced from the near field's end; with VISIBLE_BY_RAYS it
// sees what the ray hits instead, by the finest voxels there: in coarser ones surfaces that the ray doesn't see are
// averaged with those that it does. At a perfect mirror such a ray goes on like a path of the near field. With EMISSION
// voxels hold what surfaces emit, and near hits add theirs. Needs the bindings of shaders/scene/scene.glsl and of
// radiance voxels.
//
//        o────────┤        o: start; ┤: end of the near field
//     ───x────────┴──      The cone is traced to the right of it: it doesn't read what voxels hold of the
//        surface           surface at the start, or of what lies before it.
#ifndef VOXRAY_RESOLVE_CONE_RAY_GLSL
#define VOXRAY_RESOLVE_CONE_RAY_GLSL

#ifdef VISIBLE_BY_RAYS
#include "passes/cones/radiance/radiance_at_hit.glsl"
#else
#include "passes/cones/radiance/radiance_cone.glsl"
#endif
#include "shaders/scene/octahedral.glsl"
#include "shaders/scene/sampling.glsl"
#include "passes/surfels/mirror_at_hit.glsl"

layout(scalar) readonly buffer Rays { Ray data[]; } rays;
layout(scalar) readonly buffer Hits { Hit data[]; } hits;
layout(scalar) buffer Light { vec4 data[]; } light;  // By cone of the batch: its radiance times pi.
#ifdef NEAR_FIELD
// Near hits, in any order; `parent` is the cone.
layout(scalar) writeonly buffer Surfels { Surfel data[]; } surfels;
// By surfel: 1, and the geometric normal, octahedral.
layout(scalar) writeonly buffer Continuations { uvec2 data[]; } continuations;
buffer Count { uint value; } count;  // Of surfels.

// Stores the hit of a ray from a cone's start, or from an earlier hit. A hit beyond the near field is stored where it is
// on a perfect mirror alone. False for one that is not stored.
bool addHit(Hit hit, Ray ray, bool isNear, uint parent, vec3 throughput, uint id) {
    Surfel surfel;
    vec3 normal;
    float offset;
    if (!surfelAtHit(hit, ray.origin, surfel, normal, offset)) return isNear;
    if (!reflectAtMirror(hit, ray.origin, normal, surfel) && !isNear) return false;
#ifdef EMISSION
    light.data[parent].rgb += PI * throughput * emittedTowards(hit, ray);
#endif
    surfel.position += offset * normal;
    surfel.reflectance *= throughput;
    surfel.id = id;
    surfel.parent = parent;
    const uint index = atomicAdd(count.value, 1u);
    surfels.data[index] = surfel;
    continuations.data[index] = uvec2(1u, toOctahedral(normal));
    return true;
}
#endif

#ifdef VISIBLE_BY_RAYS
vec3 radianceAlong(Ray ray, Hit hit, float dither) {
    Surfel surfel;
    vec3 normal;
    float offset;
    if (!surfelAtHit(hit, ray.origin, surfel, normal, offset)) return vec3(0.0);
    return radianceAtHit(surfel.position, normal, startLevel(surfel.position, dither));
}
#endif

// Resolves ray i, which carries `throughput` of the incident radiance to cone `parent`. `ng`: unit geometric normal at
// its start. With a `range` of 0, m, there is no near field.
void resolveConeRay(uint i, uint parent, vec3 ng, vec3 throughput, float width, float range, uint id, vec2 dither) {
    const Ray ray = rays.data[i];
    const Hit hit = hits.data[i];
    if (ray.tMax < 0.0) return;
#ifdef NEAR_FIELD
#ifdef VISIBLE_BY_RAYS
    const bool asksForMirrors = range > 0.0;
#else
    const bool asksForMirrors = false;
#endif
    if (hit.triangle != NO_HIT && (asksForMirrors || hit.t < range) &&
        addHit(hit, ray, hit.t < range, parent, throughput, id))
        return;
#endif
#ifdef VISIBLE_BY_RAYS
    const vec3 radiance = radianceAlong(ray, hit, dither.x);
#else
    const ConeBase base = coneBase(ray.origin, ng, dither.x, range);
    const vec3 radiance = coneRadiance(base, ray.direction, width, dither.y - 0.5);
#endif
    light.data[parent].rgb += PI * throughput * radiance;
}

#endif
