#include "passes/common/compute/prefix_sum.h"

namespace voxray {
namespace {

constexpr uint32_t kBlockWords = 1024;  // As in prefix_sum.comp.

struct Push {
    uint32_t count;
    uint32_t blocks;
};

Program stage(Device& device, const ShaderCompiler& compiler, const char* name) {
    return makeComputeProgram(device,
                              compiler.compile("passes/common/compute/prefix_sum.comp", {{name, "1"}}));
}

}  // namespace

PopulationPrefixSum::PopulationPrefixSum(Device& device, const ShaderCompiler& compiler)
    : sumBlocks_(stage(device, compiler, "SUM_BLOCKS")),
      scanBlocks_(stage(device, compiler, "SCAN_BLOCKS")),
      scanWords_(stage(device, compiler, "SCAN_WORDS")) {}

uint32_t PopulationPrefixSum::run(CommandStream& stream, const Buffer& words, const Buffer& before,
                                  uint32_t count) const {
    const uint32_t blocks = (count + kBlockWords - 1) / kBlockWords;
    // One sum a block and, after them, the total.
    const Buffer sums(stream.device(), "prefix sum blocks", (uint64_t(blocks) + 1) * sizeof(uint32_t));
    const Push push{count, blocks};
    const auto bindings = {ifUsed({"source", words}), ifUsed({"result", before}), Binding{"blockSums", sums}};
    stream.dispatch(sumBlocks_, bindings, push, {blocks, 1, 1});
    stream.dispatch(scanBlocks_, bindings, push, {1, 1, 1});
    stream.dispatch(scanWords_, bindings, push, {blocks, 1, 1});
    return stream.readAs<uint32_t>(sums, size_t(blocks) + 1).back();
}

}  // namespace voxray
