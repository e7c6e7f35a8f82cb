// A surfel where a ray hit a surface. Needs the bindings of shaders/scene/scene.glsl.
#ifndef VOXRAY_SURFEL_AT_HIT_GLSL
#define VOXRAY_SURFEL_AT_HIT_GLSL

#include "shaders/scene/scene.glsl"
#include "passes/surfels/surfel_types.h"
#include "shaders/trace/ray_types.h"
#include "shaders/voxels/voxel_types.h"

// The surfel at the hit of a ray from `origin`, on the side that the ray came from: shading normal, diffuse albedo,
// area 1, no voxel; the caller sets id and parent. False where the ray hit nothing or a triangle without area.
// `faceNormal`: unit geometric normal on the same side. `offset`: m; the position is on the surface, and rays may begin
// that far along the face normal.
bool surfelAtHit(Hit hit, vec3 origin, out Surfel s, out vec3 faceNormal, out float offset) {
    s = Surfel(vec3(0.0), NO_VOXEL, vec3(0.0), 0u, vec3(0.0), 0u, 1.0);
    faceNormal = vec3(0.0);
    offset = 0.0;
    if (hit.triangle == NO_HIT) return false;
    const SurfacePoint p = surfacePoint(hit.triangle, vec2(hit.u, hit.v));
    if (dot(p.geometricNormal, p.geometricNormal) == 0.0) return false;
    faceNormal = dot(p.geometricNormal, origin - p.position) >= 0.0 ? p.geometricNormal : -p.geometricNormal;
    const GpuMaterial m = sceneMaterials.data[p.material];
    const vec3 normal = shadingNormal(m, p, 0.0);
    s.position = p.position;
    offset = p.offset;
    s.normal = dot(normal, faceNormal) < 0.0 ? -normal : normal;
    s.reflectance = clamp(diffuseAlbedo(m, p, 0.0), 0.0, 1.0);
    return true;
}

#endif
