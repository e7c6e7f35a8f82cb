#include "passes/find_patches/part_search.h"

#include <algorithm>
#include <bit>

#include "passes/common/compute/dispatch.h"
#include "passes/common/compute/uints.h"

namespace voxray {
namespace {

struct AssignPush {
    uint32_t sides;
    uint32_t parts;
};

}  // namespace

PartSearch::PartSearch(Device& device, const ShaderCompiler& compiler)
    : prefixSum_(device, compiler, PrefixSum::Of::Values),
      compaction_(device, compiler),
      histogram_(device, compiler),
      radixSort_(device, compiler) {
    const auto program = [&](const char* name) {
        const std::string file = std::string("passes/find_patches/") + name + ".comp";
        return makeComputeProgram(device, compiler.compile(file));
    };
    label_ = program("label");
    spread_ = program("spread");
    flag_ = program("flag");
    number_ = program("number");
    assign_ = program("assign");
    parts_ = program("parts");
}

void PartSearch::plan(MemoryPlan& plan, uint64_t sides) {
    plan.reserve("parts of clusters (estimated)", sides * sizeof(gpu::ClusterPart) + 2 * uints(sides));
    plan.reserve("sort of sides (estimated)", RadixSort::scratchBytes(uint32_t(sides)));
}

uint64_t PartSearch::scratchBytes(uint64_t sides) {
    // Labels, leaders, numbers and keys; there are no more parts than sides, so of these counts and what is
    // before; a bit a side, and what the compaction and the prefix sum take
    const uint64_t words = (sides + 31) / 32;
    return 6 * uints(sides) + 2 * uints(words) + 2 * PrefixSum::scratchBytes(uint32_t(sides)) + uints(1);
}

void PartSearch::find(CommandStream& stream, const VoxelClusters& clusters, VoxelPatches& patches) {
    Device& device = stream.device();
    const uint32_t sides = patches.sideCount, words = (sides + 31) / 32;
    const Buffer labels(device, "labels of sides", uints(sides));
    const Buffer changed(device, "labels that changed", uints(1));
    stream.dispatch(label_, {{"labels", labels}}, sides, linearGroups(sides));
    for (bool isDone = false; !isDone;) {
        stream.fill(changed, 0);
        stream.dispatch(spread_,
                        {{"sides", patches.sides},
                         {"firstNeighbour", patches.firstNeighbour},
                         {"NeighboursAt", patches.neighbours.at()},
                         {"ofVoxel", clusters.ofVoxel},
                         {"labels", labels},
                         {"changed", changed}},
                        sides, linearGroups(sides));
        isDone = stream.readAs<uint32_t>(changed, 1)[0] == 0;
    }
    const Buffer flags(device, "sides that lead parts", uints(words));
    const Buffer leaders(device, "leaders of parts", uints(sides)), numbers(device, "parts", uints(sides));
    stream.dispatch(
        flag_,
        {{"sides", patches.sides}, {"ofVoxel", clusters.ofVoxel}, {"labels", labels}, {"flags", flags}},
        sides, linearGroups(words));
    patches.partCount = compaction_.run(stream, flags, leaders, words);
    stream.fill(numbers, NO_PART);
    stream.dispatch(number_, {{"leaders", leaders}, {"numbers", numbers}}, patches.partCount,
                    linearGroups(patches.partCount));

    // Sides by part: the sort is stable, so those of a part stay in their order
    Buffer keys(device, "parts of sides", uints(sides));
    patches.ofSide = Buffer(device, "parts of sides", uints(sides));
    patches.members = Buffer(device, "sides by part", uints(sides));
    patches.parts =
        Buffer(device, "parts of clusters", std::max(patches.partCount, 1u) * sizeof(gpu::ClusterPart));
    stream.dispatch(assign_,
                    {{"labels", labels},
                     {"numbers", numbers},
                     {"ofSide", patches.ofSide},
                     {"keys", keys},
                     {"members", patches.members}},
                    AssignPush{sides, patches.partCount}, linearGroups(sides));
    radixSort_.record(stream, keys, patches.members, sides, uint32_t(std::bit_width(patches.partCount)));
    const Buffer counts(device, "sides of parts", uints(patches.partCount));
    const Buffer before(device, "sides before parts", uints(patches.partCount));
    histogram_.record(stream, patches.ofSide, counts, sides, patches.partCount);
    prefixSum_.run(stream, counts, before, patches.partCount);
    stream.dispatch(parts_, {{"counts", counts}, {"before", before}, {"parts", patches.parts}},
                    patches.partCount, linearGroups(patches.partCount));
    stream.finish();
}

}  // namespace voxray
