#include "passes/common/compute/prefix_sum.h"

#include <cstring>

namespace voxray {
namespace {

constexpr uint32_t kBlockValues = 1024, kThreads = 256;  // As in prefix_sum.comp.

uint32_t scanBlocksOf(uint32_t count) {
    return count / kBlockValues + (count % kBlockValues > 0 ? 1 : 0);
}

Defines stage(const char* name, PrefixSum::Input input) {
    return input == PrefixSum::Input::SetBits ? Defines{{name, "1"}, {"SET_BITS", "1"}} : Defines{{name, "1"}};
}

}  // namespace

PrefixSum::PrefixSum(ProgramOwner& owner, Input input)
    : sumBlocks_(owner, "prefix_sum.comp", stage("SUM_BLOCKS", input)),
      scanBlocks_(owner, "prefix_sum.comp", stage("SCAN_BLOCKS", input)),
      scanValues_(owner, "prefix_sum.comp", stage("SCAN_VALUES", input)) {}

uint64_t PrefixSum::scratchBytes(uint32_t count) {
    return (uint64_t(scanBlocksOf(count)) + 1) * sizeof(uint32_t);
}

void PrefixSum::record(CommandStream& stream, const Buffer& source, const Buffer& before, const Buffer& blockSums,
                       uint32_t count) const {
    const uint32_t blocks = scanBlocksOf(count);
    const Bindings bindings{ifUsed({"source", source}),
                            ifUsed({"result", before}),
                            {"blockSums", blockSums},
                            {"count", count},
                            {"blocks", blocks}};
    const uint64_t threads = uint64_t(blocks) * kThreads;
    stream.dispatch(sumBlocks_, threads, bindings);
    stream.dispatch(scanBlocks_, kThreads, bindings);
    stream.dispatch(scanValues_, threads, bindings);
}

uint32_t PrefixSum::run(CommandStream& stream, const Buffer& source, const Buffer& before, uint32_t count) const {
    const Buffer sums(stream.device(), "prefix sum blocks", scratchBytes(count));
    record(stream, source, before, sums, count);
    return sum(stream, sums);
}

uint32_t PrefixSum::sum(CommandStream& stream, const Buffer& blockSums) {
    uint32_t sum = 0;
    const std::vector<std::byte> last = stream.read(blockSums, sizeof sum, blockSums.bytes() - sizeof sum);
    std::memcpy(&sum, last.data(), sizeof sum);
    return sum;
}

}  // namespace voxray
