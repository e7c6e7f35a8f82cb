// The voxel grid's structs, shared by C++ (passes/common/voxels/voxels.h) and GLSL
// (shaders/voxels/voxels.glsl).
#ifndef VOXRAY_SHARED_VOXEL_TYPES_H
#define VOXRAY_SHARED_VOXEL_TYPES_H

#include "shaders/shared/types.h"

VOXRAY_SHARED_BEGIN

// A box of cubic voxels. Voxel (x, y, z) spans origin + voxelSize * [x, x+1] and so on. Rows along x are
// padded to whole 32-bit words, so that one word holds the occupancy of 32 neighbours. Of each axis at most
// `side` voxels are held, from `first` on; each has its slot at its coordinates modulo `side`, so that what
// stays held stays in place when `first` moves.
struct VoxelGrid {
    vec3 origin;      // m
    float voxelSize;  // m
    uvec3 resolution;
    uint wordsPerRow;  // ceil(min(resolution.x, side) / 32)
    uint directions;   // 6: a voxel's light is read by the face that a surface turns to; 1: all faces share
                       // one value.
    uint windowSize;   // A power of two; no less than the resolution where all is held, as everywhere but in
                       // windows.
    ivec3 first;       // 0 along axes that are held whole.
};

// What a surface voxel holds of the surfaces in it; packed: voxel_packing.h. Averages are weighted by area.
struct VoxelMaterial {
    vec3 albedo;    // Diffuse reflectance.
    float opacity;  // Fraction of 4x4 sub-samples that surfaces meet, along the axis where it is largest.
    vec3 normal;  // Mean of the front-side shading normals, not normalised: a length below 1 tells of spread.
    float area;   // Surface area in units of a voxel's face.
    vec3 emission;   // W/(m² sr)
    float metallic;  // 0 to 1; what it takes is already off the albedo.
    // The part of the area that open space lies in front of, by face: area * (normal component)², times the
    // fraction of visible sides. A surface has two sides, so a bare sheet counts at both faces across an
    // axis.
    vec3 unoccludedPositive;  // At the faces +x, +y, +z.
    vec3 unoccludedNegative;  // At the faces -x, -y, -z.
    float roughness;          // 0 to 1, as glTF's: perceptual.
};

VOXRAY_SHARED_END

#endif
