// What follows the ray through a cone's near field: where it hit, light is measured, and a ray goes on from there as a path does;
// where it did not, the cone begins at its end. Needs the bindings of shaders/scene/scene.glsl and of radiance voxels.
//
//        o────────┤        o: start; ┤: end of the near field
//     ───x────────┴──      a cone through voxels to the right of it: what they hold of the start's own
//        surface           surface, or of what stands before it, is not read
#ifndef VOXRAY_NEAR_END_GLSL
#define VOXRAY_NEAR_END_GLSL

#include "passes/cones/radiance/radiance_cone.glsl"
#include "shaders/scene/octahedral.glsl"
#include "passes/surfels/surfel_at_hit.glsl"

layout(scalar) readonly buffer Rays { Ray data[]; } rays;
layout(scalar) readonly buffer Hits { Hit data[]; } hits;
layout(scalar) buffer Light { vec4 data[]; } light;  // By cone of the batch: radiance that it brings, times pi.
// The near hits, in any order; `parent` is the cone.
layout(scalar) writeonly buffer Surfels { Surfel data[]; } surfels;
layout(scalar) writeonly buffer GoesOn { uvec2 data[]; } goesOn;  // By surfel: 1, and the geometric normal, octahedral.
buffer Count { uint value; } count;                               // Of surfels.

// The end of ray i, which brings `throughput` of what arrives along it to cone `parent`. `side`: unit geometric normal where it starts.
// `range` of 0: whatever it hit, the cone begins at the start.
void endRay(uint i, uint parent, vec3 side, vec3 throughput, float width, float range, uint id, vec2 dither) {
    const Ray ray = rays.data[i];
    const Hit hit = hits.data[i];
    if (ray.tMax < 0.0) return;
    if (hit.triangle != NO_HIT && hit.t < range) {
        Surfel at;
        vec3 normal;
        float offset;
        if (!surfelAtHit(hit, ray.origin, at, normal, offset)) return;
        at.position += offset * normal;
        at.reflectance *= throughput;
        at.id = id;
        at.parent = parent;
        const uint number = atomicAdd(count.value, 1u);
        surfels.data[number] = at;
        goesOn.data[number] = uvec2(1u, toOctahedral(normal));
        return;
    }
    const ConeBase base = coneBase(ray.origin, side, dither.x, range);
    light.data[parent].rgb += 3.14159265358979 * throughput * coneRadiance(base, ray.direction, width, dither.y - 0.5);
}

#endif
