// The grid of a radiance cache, shared by C++ (passes/cache/radiance_cache.h) and GLSL.
#ifndef VOXRAY_SHARED_RADIANCE_CACHE_TYPES_H
#define VOXRAY_SHARED_RADIANCE_CACHE_TYPES_H

#include "shaders/shared/types.h"

VOXRAY_SHARED_BEGIN

// Cells are the cubes of an octree: on level l their edge is `edge` / 2^l. The level at a position follows
// from its distance to `camera`.
struct RadianceCacheGrid {
    vec3 origin;               // m: corner of a cube around the scene.
    float edge;                // m: of that cube.
    vec3 camera;               // m
    float cellSize;            // Maximum edge of a cell over its distance from the camera.
    uint capacity;             // Slots of the hash table; a power of two.
    uint normalBins;           // Bins of normals along each edge of a cube map's face.
    float unitsPerIrradiance;  // Fixed-point units of 1 W/m².
};

#define RADIANCE_CACHE_LEVELS 17u           // Levels 0 to 16: coordinates of cells have 17 bits.
#define RADIANCE_CACHE_PROBES 16u           // Slots that are probed for a key.
#define RADIANCE_CACHE_SAMPLE_UNITS 65536u  // Fixed-point units of one sample.

VOXRAY_SHARED_END

#endif
