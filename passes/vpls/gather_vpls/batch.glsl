// The receivers of a batch: texels of the G-buffer, each subset an image of every n-th; or, with SURFELS, every n-th surfel.
#include "passes/vpls/gather_vpls/gather_types.h"

#ifdef SURFELS
// The number of a surfel of the batch; it may be past the last.
uint batchSurfel(VplBatch b, uint i) { return (b.first + i) * b.block * b.block + b.subset; }

bool isOutside(VplBatch b, uint surfel) { return surfel >= b.receivers.x; }
#else
// The G-buffer's texel of one of the batch; it may lie outside.
ivec2 batchTexel(VplBatch b, uint i) {
    const uint columns = (b.receivers.x + b.block - 1u) / b.block, at = b.first + i;
    return ivec2(uvec2(at % columns, at / columns) * b.block + uvec2(b.subset % b.block, b.subset / b.block));
}

bool isOutside(VplBatch b, ivec2 texel) { return any(greaterThanEqual(texel, ivec2(b.receivers))); }
#endif

// Whether a virtual light has bounces enough left for the receiver.
bool isCounted(VplBatch b, uint vpl) { return vpl % b.bounces + b.reflections < b.bounces; }
