#include "passes/common/compute/radix_sort.h"

#include <utility>

#include "base/error.h"

namespace voxray {
namespace {

constexpr uint32_t kBlockPairs = 4096, kDigits = 16, kDigitBits = 4,
                   kSortThreads = 256;  // As in radix_sort.comp.
constexpr uint32_t kMaxBlocks = 32768;  // A row of work groups.

uint32_t sortBlocksOf(uint32_t count) {
    return count / kBlockPairs + (count % kBlockPairs > 0 ? 1 : 0);
}

}  // namespace

RadixSort::RadixSort(ProgramOwner& owner)
    : prefixSum_(owner, PrefixSum::Of::Values),
      count_(owner, "radix_sort.comp", {{"COUNT_DIGITS", "1"}}),
      scatter_(owner, "radix_sort.comp", {{"SCATTER", "1"}}) {}

void RadixSort::record(CommandStream& stream, Buffer& keys, Buffer& values, uint32_t count,
                       uint32_t keyBits) {
    if (count == 0) return;
    const uint32_t blocks = sortBlocksOf(count), counts = blocks * kDigits;
    if (blocks > kMaxBlocks)
        throw Error("a radix sort takes at most {} pairs; these are {}", uint64_t(kMaxBlocks) * kBlockPairs,
                    count);
    Device& device = stream.device();
    const auto require = [&](Buffer& buffer, const char* name, uint64_t bytes) {
        if (!buffer || buffer.bytes() != bytes) buffer = Buffer(device, name, bytes);
    };
    require(otherKeys_, "radix sort keys", keys.bytes());
    require(otherValues_, "radix sort values", values.bytes());
    require(counts_, "radix sort counts", uint64_t(counts) * sizeof(uint32_t));
    require(blockSums_, "radix sort sums", PrefixSum::scratchBytes(counts));

    for (uint32_t shift = 0; shift < keyBits; shift += kDigitBits) {
        const Bindings digit{
            {"keys", keys}, {"counts", counts_}, {"count", count}, {"shift", shift}, {"blocks", blocks}};
        stream.dispatch(count_, blocks * kSortThreads, digit);
        prefixSum_.record(stream, counts_, counts_, blockSums_, counts);
        stream.dispatch(
            scatter_, blocks * kSortThreads,
            {digit.all(), {"values", values}, {"sortedKeys", otherKeys_}, {"sortedValues", otherValues_}});
        std::swap(keys, otherKeys_);
        std::swap(values, otherValues_);
    }
}

}  // namespace voxray
