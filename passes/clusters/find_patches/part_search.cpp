#include "passes/clusters/find_patches/part_search.h"

#include <algorithm>
#include <bit>

#include "passes/common/compute/uints.h"

namespace voxray {

PartSearch::PartSearch(ProgramOwner& owner)
    : prefixSum_(owner, PrefixSum::Of::Values),
      compaction_(owner),
      histogram_(owner),
      radixSort_(owner),
      label_(owner, "label.comp"),
      spread_(owner, "spread.comp"),
      flag_(owner, "flag.comp"),
      number_(owner, "number.comp"),
      assign_(owner, "assign.comp"),
      parts_(owner, "parts.comp") {}

void PartSearch::find(CommandStream& stream, const VoxelClusters& clusters, VoxelPatches& patches) {
    Device& device = stream.device();
    const uint32_t sides = patches.sideCount, words = (sides + 31) / 32;
    const Buffer labels(device, "labels of sides", uints(sides));
    const Buffer changed(device, "labels that changed", uints(1));
    stream.dispatch(label_, sides, {{"labels", labels}, {"sideCount", sides}});
    for (bool isDone = false; !isDone;) {
        stream.fill(changed, 0);
        stream.dispatch(spread_, sides,
                        {{"sides", patches.sides},
                         {"firstNeighbour", patches.firstNeighbour},
                         {"NeighboursAt", patches.neighbours.at()},
                         {"ofVoxel", clusters.ofVoxel},
                         {"labels", labels},
                         {"changed", changed},
                         {"sideCount", sides}});
        isDone = stream.readAs<uint32_t>(changed, 1)[0] == 0;
    }
    const Buffer flags(device, "sides that lead parts", uints(words));
    const Buffer leaders(device, "leaders of parts", uints(sides)), numbers(device, "parts", uints(sides));
    stream.dispatch(flag_, words,
                    {{"sides", patches.sides},
                     {"ofVoxel", clusters.ofVoxel},
                     {"labels", labels},
                     {"flags", flags},
                     {"sideCount", sides}});
    patches.partCount = compaction_.run(stream, flags, leaders, words);
    stream.fill(numbers, NO_PART);
    stream.dispatch(number_, patches.partCount,
                    {{"leaders", leaders}, {"numbers", numbers}, {"parts", patches.partCount}});

    // Sides by part: the sort is stable, so those of a part stay in their order
    Buffer keys(device, "parts of sides", uints(sides));
    patches.ofSide = Buffer(device, "parts of sides", uints(sides));
    patches.members = Buffer(device, "sides by part", uints(sides));
    patches.parts =
        Buffer(device, "parts of clusters", std::max(patches.partCount, 1u) * sizeof(gpu::ClusterPart));
    stream.dispatch(assign_, sides,
                    {{"labels", labels},
                     {"numbers", numbers},
                     {"ofSide", patches.ofSide},
                     {"keys", keys},
                     {"members", patches.members},
                     {"sideCount", sides},
                     {"parts", patches.partCount}});
    radixSort_.record(stream, keys, patches.members, sides, uint32_t(std::bit_width(patches.partCount)));
    const Buffer counts(device, "sides of parts", uints(patches.partCount));
    const Buffer before(device, "sides before parts", uints(patches.partCount));
    histogram_.record(stream, patches.ofSide, counts, sides, patches.partCount);
    prefixSum_.run(stream, counts, before, patches.partCount);
    stream.dispatch(
        parts_, patches.partCount,
        {{"counts", counts}, {"before", before}, {"parts", patches.parts}, {"count", patches.partCount}});
    stream.finish();
}

}  // namespace voxray
