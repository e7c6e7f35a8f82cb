#include "passes/common/compute/compaction.h"

#include "passes/common/compute/dispatch.h"

namespace voxray {

Compaction::Compaction(Device& device, const ShaderCompiler& compiler)
    : prefixSum_(device, compiler, PrefixSum::Of::SetBits),
      list_(makeComputeProgram(device, compiler.compile("passes/common/compute/compaction.comp"))) {}

uint32_t Compaction::run(CommandStream& stream, const Buffer& flags, const Buffer& indices,
                         uint32_t words) const {
    const Buffer before(stream.device(), "flagged items before", uint64_t(words) * sizeof(uint32_t));
    const uint32_t count = prefixSum_.run(stream, flags, before, words);
    stream.dispatch(list_, {{"flags", flags}, {"before", before}, {"indices", indices}}, words,
                    linearGroups(words));
    stream.finish();
    return count;
}

}  // namespace voxray
