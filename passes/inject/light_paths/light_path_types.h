// What a ray from a light carries and what sends it, shared by C++ (passes/inject/light_paths/) and GLSL
// (passes/inject/light_paths/light_emission.glsl).
#ifndef VOXRAY_SHARED_LIGHT_PATH_H
#define VOXRAY_SHARED_LIGHT_PATH_H

#include "shaders/shared/types.h"

// How a ray of light goes on from a surface (Secondary of passes/inject/light_paths/light_paths.h).
#define SECONDARY_NONE 0u
#define SECONDARY_MIRROR 1u
#define SECONDARY_DIFFUSE 2u
#define SECONDARY_MATERIAL 3u

// Of the ring round a region, in radii of the sphere round it: what lies farther away adds little light to
// that of the ring.
#define RING_RADII 4.0f

VOXRAY_SHARED_BEGIN

// The ray stands for a beam whose cross-section after d metres is area + solidAngle * d². Light from
// surfaces, from the environment and after diffuse reflection has none: both are 0.
struct LightPath {
    vec3 power;        // W
    float solidAngle;  // sr; 0 for parallel light
    float area;        // m²; 0 for light from a point
    float travelled;   // m, from the light to the ray's origin
};

// A source of light and the rays that it sends.
struct EmittingSource {
    uint kind;  // As LightSource has it, and `light`.
    uint light;
    uint emitterCount;  // Emissive triangles of the scene.
    uint rays;          // That the source sends.
    uint seed;          // One for each source.
    vec3 sceneCenter;   // m, of the sphere round the scene's region.
    float sceneRadius;  // m
    float reach;        // m: as far from the center there are surfaces.
    float start;        // m: as far before the center parallel light and the environment begin.
};

VOXRAY_SHARED_END

#endif
