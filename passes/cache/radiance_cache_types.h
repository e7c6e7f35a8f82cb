// The grid of a radiance cache, shared by C++ (passes/cache/radiance_cache.h) and GLSL.
#ifndef VOXRAY_SHARED_RADIANCE_CACHE_TYPES_H
#define VOXRAY_SHARED_RADIANCE_CACHE_TYPES_H

#include "shaders/shared/types.h"

VOXRAY_SHARED_BEGIN

// Cells are cubes of an octree's levels: those of level l have the edge `edge` / 2^l. Which level a point
// takes follows from its distance to `camera`.
struct RadianceCacheGrid {
    vec3 origin;               // m: corner of a cube round the scene.
    float edge;                // m: of that cube.
    vec3 camera;               // m
    float cellSize;            // Largest edge of a cell, over its distance from the camera.
    uint capacity;             // Slots of the table; a power of two.
    uint normalBins;           // Of normals, along each edge of each face of a cube.
    float unitsPerIrradiance;  // Of sums, for 1 W/m².
};

#define RADIANCE_CACHE_LEVELS 17u           // 0 to 16: coordinates of cells take 17 bits.
#define RADIANCE_CACHE_PROBES 16u           // Slots in which a key may lie.
#define RADIANCE_CACHE_SAMPLE_UNITS 65536u  // Of the number of samples.

VOXRAY_SHARED_END

#endif
