// Which shadow rays a batch traces, shared by C++ and GLSL.
#ifndef VOXRAY_GATHER_VPLS_TYPES_H
#define VOXRAY_GATHER_VPLS_TYPES_H

#include "shaders/shared/types.h"

VOXRAY_SHARED_BEGIN

// Rays from so many receivers of a subset to so many of the subset's virtual lights. Receivers follow each
// other, then lights. Receivers are texels of the G-buffer, or surfels that rays from texels hit (SURFELS).
struct VplBatch {
    uvec2 receivers;          // Texels of the G-buffer; or the number of surfels, and 1.
    uint block;               // Texels along its edge; subsets are its square.
    uint subset;              // Row by row within the block.
    uint first, count;        // Receivers, of those of the subset.
    uint firstVpl, vplCount;  // Of the list of virtual lights.
    uint bounces;             // Of a path: virtual light v is of bounce v % bounces.
    uint reflections;  // Between the receiver and the texel: virtual lights of the last so many bounces count
                       // no more.
};

VOXRAY_SHARED_END

#endif
