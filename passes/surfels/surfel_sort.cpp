#include "passes/surfels/surfel_sort.h"

#include <algorithm>

#include "passes/surfels/surfel_links.h"

namespace voxray {
namespace {

constexpr uint64_t kListBytes = 2 * sizeof(uint32_t);

}  // namespace

SurfelSort::SurfelSort(ProgramOwner& owner)
    : count_(owner, "count_surfels.comp"),
      sort_(owner, "scatter_surfels.comp"),
      order_(owner, "sort_voxel_surfels.comp"),
      prefixSum_(owner, PrefixSum::Of::Values) {}

void SurfelSort::run(CommandStream& stream, const Surfels& surfels, uint32_t voxels,
                     SurfelsByVoxel& to) const {
    Device& device = stream.device();
    to.lists = {}, to.sorted = {}, to.sortedIndices = {};
    to.lists = Buffer(device, "lists of surfels by voxel", voxels * kListBytes);
    const Buffer begins(device, "first surfel of each voxel", voxels * sizeof(uint32_t));
    const Buffer ends(device, "last surfel of each voxel", voxels * sizeof(uint32_t));
    stream.fill(begins, 0);
    for (const Surfels::Chunk& chunk : surfels.chunks)
        stream.dispatch(count_, chunk.count,
                        {{"surfels", chunk.surfels}, {"counts", begins}, {"count", chunk.count}});
    to.sortedCount = prefixSum_.run(stream, begins, begins, voxels);
    stream.copy(begins, ends, voxels * sizeof(uint32_t));
    to.sorted =
        LargeBuffer(device, "surfels by voxel", std::max(to.sortedCount, 1u) * sizeof(gpu::SortedSurfel));
    to.sortedIndices =
        LargeBuffer(device, "slots of surfels", std::max<uint64_t>(surfels.count, 1) * sizeof(uint32_t));
    stream.fill(to.sortedIndices, SurfelLinks::kNone);
    uint32_t first = 0;
    for (const Surfels::Chunk& chunk : surfels.chunks) {
        stream.dispatch(sort_, chunk.count,
                        {{"surfels", chunk.surfels},
                         {"SortedRef", to.sorted.ref()},
                         {"ends", ends},
                         {"count", chunk.count},
                         {"firstNumber", first}});
        first += chunk.count;
    }
    stream.dispatch(order_, voxels,
                    {{"SortedRef", to.sorted.ref()},
                     {"SortedIndicesRef", to.sortedIndices.ref()},
                     {"begins", begins},
                     {"ends", ends},
                     {"lists", to.lists},
                     {"voxels", voxels}});
    stream.finish();
}

}  // namespace voxray
