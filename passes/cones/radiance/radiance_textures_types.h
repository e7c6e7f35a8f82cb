// Layout of radiance voxels in a 3D texture, shared by C++ (passes/cones/filter_voxels/textures.cpp) and
// GLSL (passes/cones/radiance/radiance_textures.glsl).
#ifndef VOXRAY_SHARED_RADIANCE_TEXTURES_TYPES_H
#define VOXRAY_SHARED_RADIANCE_TEXTURES_TYPES_H

#include "shaders/shared/types.h"

VOXRAY_SHARED_BEGIN

struct TextureLayout {
    uvec3 extent;  // Texels of one face in mip level 0: powers of two, since mip levels are rounded down and
                   // levels of voxels up.
    uvec3 along;   // 1 for the axis along which faces lie side by side, the grid's longest; 0 for the others.
};

VOXRAY_SHARED_END

#endif
