#include "passes/surfels/surfel_sort.h"

#include <algorithm>

namespace voxray {
namespace {

constexpr uint64_t kListBytes = 2 * sizeof(uint32_t);

}  // namespace

SurfelSort::SurfelSort(ProgramOwner& owner)
    : count_(owner, "count_surfels.comp"),
      scatter_(owner, "scatter_surfels.comp"),
      sortVoxel_(owner, "sort_voxel_surfels.comp"),
      prefixSum_(owner, PrefixSum::Input::Uints) {}

void SurfelSort::run(CommandStream& stream, const Surfels& surfels, uint32_t voxels, SurfelsByVoxel& result) const {
    Device& device = stream.device();
    result.ranges = {}, result.sorted = {}, result.sortedIndices = {};
    result.ranges = Buffer(device, "lists of surfels by voxel", voxels * kListBytes);

    // Each voxel's range
    const Buffer begins(device, "first surfel of each voxel", voxels * sizeof(uint32_t));
    const Buffer ends(device, "last surfel of each voxel", voxels * sizeof(uint32_t));
    stream.fill(begins, 0);
    for (const Surfels::Chunk& chunk : surfels.chunks)
        stream.dispatch(count_, chunk.count, {{"surfels", chunk.surfels}, {"counts", begins}, {"count", chunk.count}});
    result.sortedCount = prefixSum_.run(stream, begins, begins, voxels);
    stream.copy(begins, ends, voxels * sizeof(uint32_t));

    result.sorted =
        LargeBuffer(device, "surfels by voxel", std::max(result.sortedCount, 1u) * sizeof(gpu::SortedSurfel));
    result.sortedIndices = LargeBuffer(device, "indices of surfels in their sorted order",
                                       std::max<uint64_t>(surfels.count, 1) * sizeof(uint32_t));
    stream.fill(result.sortedIndices, SurfelsByVoxel::kNone);
    for (const Surfels::Chunk& chunk : surfels.chunks)
        stream.dispatch(scatter_, chunk.count,
                        {{"surfels", chunk.surfels},
                         {"SortedRef", result.sorted.ref()},
                         {"ends", ends},
                         {"count", chunk.count},
                         {"firstIndex", chunk.firstIndex}});
    stream.dispatch(sortVoxel_, voxels,
                    {{"SortedRef", result.sorted.ref()},
                     {"SortedIndicesRef", result.sortedIndices.ref()},
                     {"begins", begins},
                     {"ends", ends},
                     {"surfelRanges", result.ranges},
                     {"voxels", voxels}});
    stream.finish();
}

}  // namespace voxray
