// The surfel of a point of a face. Needs the bindings of shaders/scene/scene.glsl.
#ifndef VOXRAY_FACE_POINT_GLSL
#define VOXRAY_FACE_POINT_GLSL

#include "passes/cache/hit_faces/hit_face.glsl"
#include "passes/cache/hit_faces/face_point_types.h"
#include "passes/surfels/surfel_types.h"
#include "shaders/scene/scene.glsl"

// `id` selects random numbers. `faceNormal_`: unit geometric normal on the face's side.
Surfel facePoint(FaceHit hit, uint id, uint parent, out vec3 faceNormal_) {
    const SurfacePoint p = surfacePoint(hit.triangle, vec2(hit.u, hit.v));
    faceNormal_ = normalAtFace(p.geometricNormal, hit.face);
    const vec3 normal = shadingNormal(sceneMaterials.data[p.material], p, 0.0);
    Surfel s;
    s.position = p.position + p.offset * faceNormal_;
    s.voxel = hit.face;
    s.normal = dot(normal, faceNormal_) < 0.0 ? -normal : normal;
    s.id = id;
    s.reflectance = vec3(1.0);
    s.parent = parent;
    s.area = 1.0;
    return s;
}

#endif
