// Receivers of a batch: subset s has every block-th texel of the G-buffer along both axes; with SURFELS every block²-th
// surfel.
#include "passes/vpls/gather_vpls/gather_types.h"

#ifdef SURFELS
// Index of receiver i; it may be past the last surfel.
uint batchSurfel(VplBatch b, uint i) { return (b.firstReceiver + i) * b.block * b.block + b.subset; }

bool isOutside(VplBatch b, uint surfel) { return surfel >= b.receiverExtent.x; }
#else
// Texel of receiver i; it may be outside of the image.
ivec2 batchTexel(VplBatch b, uint i) {
    const uint columns = (b.receiverExtent.x + b.block - 1u) / b.block, index = b.firstReceiver + i;
    return ivec2(uvec2(index % columns, index / columns) * b.block + uvec2(b.subset % b.block, b.subset / b.block));
}

bool isOutside(VplBatch b, ivec2 texel) { return any(greaterThanEqual(texel, ivec2(b.receiverExtent))); }
#endif

// Whether a virtual light's bounce, and the reflections behind it, stay within the number of bounces.
bool isWithinBounces(VplBatch b, uint vpl) { return vpl % b.bounces + b.reflections < b.bounces; }
