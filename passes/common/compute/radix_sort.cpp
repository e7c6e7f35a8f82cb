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
    : prefixSum_(owner, PrefixSum::Input::Uints),
      count_(owner, "radix_sort.comp", {{"COUNT_DIGITS", "1"}}),
      scatter_(owner, "radix_sort.comp", {{"SCATTER", "1"}}) {}

void RadixSort::record(CommandStream& stream, Buffer& keys, Buffer& values, uint32_t count, uint32_t keyBits) {
    if (count == 0) return;
    const uint32_t blocks = sortBlocksOf(count), counts = blocks * kDigits;
    if (blocks > kMaxBlocks)
        throw Error("a radix sort takes at most {} pairs; these are {}", uint64_t(kMaxBlocks) * kBlockPairs, count);
    Device& device = stream.device();
    ensureSize(sortedKeys_, device, "radix sort keys", keys.bytes());
    ensureSize(sortedValues_, device, "radix sort values", values.bytes());
    ensureSize(counts_, device, "radix sort counts", uint64_t(counts) * sizeof(uint32_t));
    ensureSize(blockSums_, device, "radix sort sums", PrefixSum::scratchBytes(counts));

    for (uint32_t shift = 0; shift < keyBits; shift += kDigitBits) {
        const Bindings digit{
            {"keys", keys}, {"counts", counts_}, {"count", count}, {"shift", shift}, {"blocks", blocks}};
        stream.dispatch(count_, blocks * kSortThreads, digit);
        prefixSum_.record(stream, counts_, counts_, blockSums_, counts);
        stream.dispatch(
            scatter_, blocks * kSortThreads,
            {digit.all(), {"values", values}, {"sortedKeys", sortedKeys_}, {"sortedValues", sortedValues_}});
        std::swap(keys, sortedKeys_);
        std::swap(values, sortedValues_);
    }
}

}  // namespace voxray
