// Paths from lights and the sources that emit them, shared by C++ and GLSL.
#ifndef VOXRAY_SHARED_LIGHT_PATH_H
#define VOXRAY_SHARED_LIGHT_PATH_H

#include "shaders/shared/types.h"

// How rays scatter at surfaces (Secondary of passes/inject/light_paths/light_paths.h).
#define SECONDARY_NONE 0u
#define SECONDARY_MIRROR 1u
#define SECONDARY_DIFFUSE 2u
#define SECONDARY_MATERIAL 3u

// Outer radius of the ring around the scene's region from which parallel light is emitted, too, in radii of
// the region's sphere: surfaces farther away add little light to that of the ring.
#define RING_RADII 4.0f

VOXRAY_SHARED_BEGIN

// A ray is a beam whose cross-section after d metres is area + solidAngle * d². Both are 0 for light from
// emissive surfaces and the environment, which has no cross-section.
struct LightPath {
    vec3 power;        // W
    float solidAngle;  // sr; 0 for parallel light
    float area;        // m²; 0 for light from a point
    float travelled;   // m, from the light to the ray's origin
};

struct EmittingSource {
    uint kind;  // As LightSource has it, and `light`.
    uint light;
    uint emitterCount;  // Emissive triangles of the scene.
    uint rays;          // Rays from this source.
    uint seed;          // A different one for each source.
    vec3 sceneCenter;   // m, of the sphere around the scene's region.
    float sceneRadius;  // m
    float reach;        // m: distance of the farthest surfaces from the center.
    float start;        // m: distance before the center where parallel and environment rays begin.
};

VOXRAY_SHARED_END

#endif
