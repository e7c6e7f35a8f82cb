// Light that is stored for surfaces, wherever that is. C++: passes/final_gather/gather_rays/stored_light.h.
#ifndef VOXRAY_STORED_LIGHT_GLSL
#define VOXRAY_STORED_LIGHT_GLSL

// What is stored for a point of a surface.
struct StoredLight {
    vec3 irradiance;  // W/m²
    float cellSize;   // m: edge of the cell that it is the mean of.
    bool known;       // False where no light was stored.
};

// Each defines, for a surface with unit normal `normal`, on the side that it points to:
// StoredLight storedLight(vec3 position, vec3 normal).
#if defined(STORED_IN_VOXELS)
#include "passes/final_gather/gather_rays/voxel_light.glsl"
#elif defined(STORED_IN_MERGED_VOXELS)
#include "passes/final_gather/gather_rays/merged_voxel_light.glsl"
#elif defined(STORED_IN_RADIANCE_CACHE)
#include "passes/final_gather/gather_rays/cached_light.glsl"
#endif

#endif
