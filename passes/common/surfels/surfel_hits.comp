#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// A surfel at the hit of each surfel's ray, on the side that the ray came from, where shadow rays will measure direct light.
// Its index is its parent's. Where a ray hit nothing the surfel has no normal and so receives nothing.
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/scene.glsl"
#include "shaders/trace/ray_types.h"
#include "shaders/surfels/surfel_types.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Surfels { Surfel data[]; } surfels;
layout(scalar) readonly buffer Hits { Hit data[]; } hits;
layout(scalar) writeonly buffer HitSurfels { Surfel data[]; } hitSurfels;
layout(push_constant) uniform Push {
    uint count;
    uint ray;   // Number of this ray among the `rays` of each surfel.
    uint rays;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const Surfel from = surfels.data[i];
    Surfel at = Surfel(vec3(0.0), 0xffffffffu, vec3(0.0), from.id * push.rays + push.ray, vec3(0.0), i, 1.0);
    const Hit hit = hits.data[i];
    if (hit.triangle != NO_HIT) {
        const SurfacePoint p = surfacePoint(hit.triangle, vec2(hit.u, hit.v));
        if (dot(p.geometricNormal, p.geometricNormal) > 0.0) {
            const GpuMaterial m = sceneMaterials.data[p.material];
            const vec3 normal = shadingNormal(m, p, 0.0);
            at.position = p.position;
            at.normal = dot(normal, from.position - p.position) < 0.0 ? -normal : normal;
            at.reflectance = diffuseAlbedo(m, p, 0.0);
        }
    }
    hitSurfels.data[i] = at;
}
