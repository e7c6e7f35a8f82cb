// The layout of gather rays, shared by C++ (passes/common/view/gather_hits.h) and GLSL
// (shaders/view/gather_layout.glsl).
#ifndef VOXRAY_SHARED_GATHER_TYPES_H
#define VOXRAY_SHARED_GATHER_TYPES_H

#include "shaders/shared/types.h"

VOXRAY_SHARED_BEGIN

struct GatherLayout {
    uvec2 texels;    // Of the G-buffer.
    uvec2 blocks;    // ceil(texels / blockSize)
    uint blockSize;  // Texels along a block's edge; a power of two.
    uint raysPerBlock;
    uint seed;
};

VOXRAY_SHARED_END

#endif
