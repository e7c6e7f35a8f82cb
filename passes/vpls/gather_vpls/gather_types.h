// The shadow rays of a batch, shared by C++ and GLSL.
#ifndef VOXRAY_GATHER_VPLS_TYPES_H
#define VOXRAY_GATHER_VPLS_TYPES_H

#include "shaders/shared/types.h"

VOXRAY_SHARED_BEGIN

// A batch: shadow rays between receivers and virtual lights of one subset. Ray v * receiverCount + r connects
// receiver r with light v. Receivers are texels of the G-buffer, or surfels (SURFELS).
struct VplBatch {
    uvec2 receiverExtent;               // Texels of the G-buffer; for surfels their number, and 1.
    uint block;                         // Edge of an interleaving block, texels; there are block² subsets.
    uint subset;                        // Index within the block, row by row.
    uint firstReceiver, receiverCount;  // Range of the subset's receivers.
    uint firstVpl, vplCount;            // Range of the subset's virtual lights in Vpls::activeIndices.
    uint bounces;                       // Per path: virtual light v belongs to bounce v % bounces.
    uint reflections;                   // Between receiver and texel: the last so many bounces are left out.
};

VOXRAY_SHARED_END

#endif
