// Resolves a ray through the near field of a cone: a hit is stored as a surfel, where direct light is sampled and a
// path continues; without a hit the cone is traced from the ray's end. Needs the bindings of shaders/scene/scene.glsl
// and of radiance voxels.
//
//        o────────┤        o: start; ┤: end of the near field
//     ───x────────┴──      The cone is traced to the right of it: it doesn't read what voxels hold of the
//        surface           surface at the start, or of what lies before it.
#ifndef VOXRAY_RESOLVE_NEAR_FIELD_RAY_GLSL
#define VOXRAY_RESOLVE_NEAR_FIELD_RAY_GLSL

#include "passes/cones/radiance/radiance_cone.glsl"
#include "shaders/scene/octahedral.glsl"
#include "passes/surfels/surfel_at_hit.glsl"

layout(scalar) readonly buffer Rays { Ray data[]; } rays;
layout(scalar) readonly buffer Hits { Hit data[]; } hits;
layout(scalar) buffer Light { vec4 data[]; } light;  // By cone of the batch: its radiance times pi.
// Near hits, in any order; `parent` is the cone.
layout(scalar) writeonly buffer Surfels { Surfel data[]; } surfels;
// By surfel: 1, and the geometric normal, octahedral.
layout(scalar) writeonly buffer Continuations { uvec2 data[]; } continuations;
buffer Count { uint value; } count;                                             // Of surfels.

// Resolves ray i, which carries `throughput` of the incident radiance to cone `parent`. `ng`: unit geometric normal at
// its start. With a `range` of 0 the cone begins at the start, whatever the ray hit.
void resolveNearFieldRay(uint i, uint parent, vec3 ng, vec3 throughput, float width, float range, uint id,
                         vec2 dither) {
    const Ray ray = rays.data[i];
    const Hit hit = hits.data[i];
    if (ray.tMax < 0.0) return;
    if (hit.triangle != NO_HIT && hit.t < range) {
        Surfel surfel;
        vec3 normal;
        float offset;
        if (!surfelAtHit(hit, ray.origin, surfel, normal, offset)) return;
        surfel.position += offset * normal;
        surfel.reflectance *= throughput;
        surfel.id = id;
        surfel.parent = parent;
        const uint index = atomicAdd(count.value, 1u);
        surfels.data[index] = surfel;
        continuations.data[index] = uvec2(1u, toOctahedral(normal));
        return;
    }
    const ConeBase base = coneBase(ray.origin, ng, dither.x, range);
    light.data[parent].rgb += 3.14159265358979 * throughput * coneRadiance(base, ray.direction, width, dither.y - 0.5);
}

#endif
