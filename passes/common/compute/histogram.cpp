#include "passes/common/compute/histogram.h"

#include "passes/common/compute/dispatch.h"

namespace voxray {
namespace {

struct HistogramPush {
    uint32_t count;
    uint32_t bins;
};

}  // namespace

Histogram::Histogram(Device& device, const ShaderCompiler& compiler)
    : count_(makeComputeProgram(device, compiler.compile("passes/common/compute/histogram.comp"))) {}

void Histogram::record(CommandStream& stream, const Buffer& values, const Buffer& counts, uint32_t count,
                       uint32_t bins) const {
    stream.fill(counts, 0);
    stream.dispatch(count_, {{"values", values}, {"counts", counts}}, HistogramPush{count, bins},
                    linearGroups(count));
}

}  // namespace voxray
