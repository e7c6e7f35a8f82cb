// Points on surfaces where irradiance is measured, shared by C++ (passes/surfels/) and GLSL.
#ifndef VOXRAY_SHARED_SURFEL_TYPES_H
#define VOXRAY_SHARED_SURFEL_TYPES_H

#include "shaders/shared/types.h"

VOXRAY_SHARED_BEGIN

// Surfel::id of a surfel that does not exist: it has no voxel, and stands for no area.
#define VOXRAY_NO_SURFEL 0xffffffffu
// A link of a surfel that did not exist when others were traced last (SurfelLinks): its light is not known yet.
#define LINK_NOT_TRACED 0xfffffffeu
// Surfel::voxel of a path's vertex on a perfect mirror (mirror_at_hit.glsl).
#define VOXRAY_MIRROR_VERTEX 0xfffffffeu

// A point on one side of a surface.
struct Surfel {
    vec3 position;     // m; off the surface, where rays may begin (SurfacePoint::offset).
    uint voxel;        // Index of its surface voxel, or NO_VOXEL.
    vec3 normal;       // Unit length, on the surfel's side; geometric, or the shading normal at a ray's hit.
    uint id;           // Seed of its random numbers; unique among surfels of a dispatch.
    vec3 reflectance;  // Diffuse albedo; of a path vertex the throughput of the path, its albedo included.
    uint parent;       // Index of the gather ray, the path or the previous vertex.
    float area;        // Surface that it stands for; 1: as one of place_surfels; 0: it is occluded.
};

VOXRAY_SHARED_END

#endif
