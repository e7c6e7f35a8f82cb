// Lookups of stored irradiance, in one of three storages. Host: passes/final_gather/gather_rays/stored_light.h.
#ifndef VOXRAY_STORED_LIGHT_GLSL
#define VOXRAY_STORED_LIGHT_GLSL

// The value stored for a surface point.
struct StoredLight {
    vec3 irradiance;  // W/m²
    float cellSize;   // Edge of the cell over which it is averaged, m.
    bool known;       // False where no light is stored.
};

// Each file defines StoredLight storedLight(vec3 position, vec3 normal), for the side of the surface that the unit
// normal points to.
#if defined(STORED_IN_VOXELS)
#include "passes/final_gather/gather_rays/voxel_light.glsl"
#elif defined(STORED_IN_MERGED_VOXELS)
#include "passes/final_gather/gather_rays/merged_voxel_light.glsl"
#elif defined(STORED_IN_RADIANCE_CACHE)
#include "passes/final_gather/gather_rays/cached_light.glsl"
#endif

#endif
