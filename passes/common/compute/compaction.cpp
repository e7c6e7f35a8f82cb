#include "passes/common/compute/compaction.h"

namespace voxray {

Compaction::Compaction(ProgramOwner& owner)
    : prefixSum_(owner, PrefixSum::Of::SetBits), list_(owner, "compaction.comp") {}

uint32_t Compaction::run(CommandStream& stream, const Buffer& flags, const Buffer& indices,
                         uint32_t words) const {
    const Buffer before(stream.device(), "flagged items before", uint64_t(words) * sizeof(uint32_t));
    const uint32_t count = prefixSum_.run(stream, flags, before, words);
    stream.dispatch(list_, words,
                    {{"flags", flags}, {"before", before}, {"indices", indices}, {"words", words}});
    stream.finish();
    return count;
}

}  // namespace voxray
