#include "passes/common/compute/histogram.h"

namespace voxray {

void Histogram::record(CommandStream& stream, const Buffer& values, const Buffer& counts, uint32_t count,
                       uint32_t bins) const {
    stream.fill(counts, 0);
    stream.dispatch(count_, count,
                    {{"values", values}, {"counts", counts}, {"count", count}, {"bins", bins}});
}

}  // namespace voxray
