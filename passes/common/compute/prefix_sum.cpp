#include "passes/common/compute/prefix_sum.h"

#include <cstring>

namespace voxray {
namespace {

constexpr uint32_t kBlockValues = 1024;  // As in prefix_sum.comp.
constexpr uint32_t kRow = 32768;         // Work groups along x; devices allow 65535.

struct ScanPush {
    uint32_t count;
    uint32_t blocks;
};

uint32_t scanBlocksOf(uint32_t count) {
    return count / kBlockValues + (count % kBlockValues > 0 ? 1 : 0);
}

Program stage(Device& device, const ShaderCompiler& compiler, const char* name, PrefixSum::Of of) {
    const Defines defines =
        of == PrefixSum::Of::SetBits ? Defines{{name, "1"}, {"SET_BITS", "1"}} : Defines{{name, "1"}};
    return makeComputeProgram(device, compiler.compile("passes/common/compute/prefix_sum.comp", defines));
}

}  // namespace

PrefixSum::PrefixSum(Device& device, const ShaderCompiler& compiler, Of of)
    : sumBlocks_(stage(device, compiler, "SUM_BLOCKS", of)),
      scanBlocks_(stage(device, compiler, "SCAN_BLOCKS", of)),
      scanValues_(stage(device, compiler, "SCAN_VALUES", of)) {}

uint64_t PrefixSum::scratchBytes(uint32_t count) {
    return (uint64_t(scanBlocksOf(count)) + 1) * sizeof(uint32_t);
}

void PrefixSum::record(CommandStream& stream, const Buffer& source, const Buffer& before,
                       const Buffer& blockSums, uint32_t count) const {
    const ScanPush push{count, scanBlocksOf(count)};
    const glm::uvec3 groups = push.blocks <= kRow ? glm::uvec3(push.blocks, 1, 1)
                                                  : glm::uvec3(kRow, (push.blocks + kRow - 1) / kRow, 1);
    const auto bindings = {ifUsed({"source", source}), ifUsed({"result", before}),
                           Binding{"blockSums", blockSums}};
    stream.dispatch(sumBlocks_, bindings, push, groups);
    stream.dispatch(scanBlocks_, bindings, push, {1, 1, 1});
    stream.dispatch(scanValues_, bindings, push, groups);
}

uint32_t PrefixSum::run(CommandStream& stream, const Buffer& source, const Buffer& before,
                        uint32_t count) const {
    const Buffer sums(stream.device(), "prefix sum blocks", scratchBytes(count));
    record(stream, source, before, sums, count);
    uint32_t sum = 0;
    const std::vector<std::byte> last = stream.read(sums, sizeof sum, scratchBytes(count) - sizeof sum);
    std::memcpy(&sum, last.data(), sizeof sum);
    return sum;
}

}  // namespace voxray
