// Points on surfaces where irradiance is measured, shared by C++ (passes/surfels/) and GLSL.
#ifndef VOXRAY_SHARED_SURFEL_TYPES_H
#define VOXRAY_SHARED_SURFEL_TYPES_H

#include "shaders/shared/types.h"

VOXRAY_SHARED_BEGIN

// A point on one side of a surface.
struct Surfel {
    vec3 position;     // m; so far off its surface that rays may begin there (SurfacePoint::offset).
    uint voxel;        // Number of its voxel, or NO_VOXEL.
    vec3 normal;       // Unit length, on the lit side; geometric, at hits the shading normal.
    uint id;           // Picks its random numbers; unique among surfels that are handled together.
    vec3 reflectance;  // Diffuse albedo; of a path's vertex times those before it, over the chance to get
                       // here.
    uint parent;       // Index of the gather ray, of the path, or of the vertex before.
    float area;  // Of surface that it stands for, 1 where surfels are spread evenly over all surfaces; 0:
                 // covered (place_surfels).
};

VOXRAY_SHARED_END

#endif
