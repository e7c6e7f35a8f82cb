// Points on hit faces, shared by C++ (passes/cache/hit_faces/) and GLSL.
#ifndef VOXRAY_SHARED_FACE_POINT_TYPES_H
#define VOXRAY_SHARED_FACE_POINT_TYPES_H

#include "shaders/shared/types.h"

#define NO_FACE 0xffffffffu       // In place of a face or of its number.
#define NOT_MEASURED 0xfffffffeu  // FaceLink::face of a kept point that has no light yet.

VOXRAY_SHARED_BEGIN

// A hit that was chosen as a point of its face.
struct FaceHit {
    uint triangle;
    float u;  // Barycentric, as in Hit.
    float v;
    uint face;  // hitFace()
};

// Where a point that is kept receives light.
struct PointPlace {
    vec3 position;  // m; off the surface, where rays begin.
    vec3 normal;    // For shading, on the face's side.
};

// What a point reads of the light of others: its ray's hit reflects `reflectance` times the irradiance of `face`.
struct FaceLink {
    vec3 reflectance;  // Over the probability that the link was kept.
    uint face;         // hitFace() of the hit, then its number; NO_FACE: nothing.
};

VOXRAY_SHARED_END

#endif
