// The voxel grid's structs, shared by C++ (passes/common/voxels/voxels.h) and GLSL
// (shaders/voxels/voxels.glsl).
#ifndef VOXRAY_SHARED_VOXEL_TYPES_H
#define VOXRAY_SHARED_VOXEL_TYPES_H

#include "shaders/shared/types.h"

#define NO_VOXEL 0xffffffffu  // In place of a surface voxel's number.

VOXRAY_SHARED_BEGIN

// A grid of cubic voxels, or a window of it. Voxel (x, y, z) spans origin + voxelSize * [x, x+1] and so on. A
// word of occupancy holds 32 voxels along x; rows are padded to whole words. The window has at most
// `windowSize` voxels along each axis, from `first` on. Addressing is toroidal: voxels are stored at their
// wrapped coordinates, modulo `windowSize`, so that they stay where they are when the window moves.
struct VoxelGrid {
    vec3 origin;      // m
    float voxelSize;  // m
    uvec3 resolution;
    uint wordsPerRow;  // ceil(min(resolution.x, windowSize) / 32)
    uint directions;   // 6: light is stored by face; 1: all faces share one value.
    uint windowSize;   // A power of two; of the resolution or more without a window.
    ivec3 first;       // 0 along axes that the window covers.
    uint firstWord;    // Of a level of VoxelLevels: of its occupancy among that of all levels; else 0.
};

// A level of VoxelLevels: a place is stored at the first level that holds its voxel. The bounds are multiples of two
// voxels, so that a voxel of the next level is held by this level as a whole, or not at all.
struct VoxelLevel {
    VoxelGrid grid;
    ivec3 first;  // Of the voxels that it holds.
    ivec3 end;
};

// Means over the surfaces in a voxel, weighted by area. Packed: voxel_packing.h.
struct VoxelMaterial {
    vec3 albedo;     // Diffuse reflectance.
    float opacity;   // Fraction of 4x4 sub-samples that surfaces cover, along the axis where it is largest.
    vec3 normal;     // Of front-side shading normals, not normalized: shorter the more they differ.
    float area;      // Surface area in units of a voxel's face.
    vec3 emission;   // W/(m² sr)
    float metallic;  // 0 to 1. The albedo includes its effect.
    // Unoccluded area by face: area * (normal component)² * fraction of visible sides. A surface has two
    // sides, so that an open sheet counts at both faces across an axis.
    vec3 unoccludedPositive;  // At the faces +x, +y, +z.
    vec3 unoccludedNegative;  // At the faces -x, -y, -z.
    float roughness;          // 0 to 1, perceptual, as in glTF.
};

VOXRAY_SHARED_END

#endif
