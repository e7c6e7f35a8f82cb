#include "passes/radiosity/link_surfels/mean_distances.h"

#include <algorithm>

namespace voxray {

MeanDistances::MeanDistances(ProgramOwner& owner)
    : measure_(owner, "mean_inverse_distance.comp"),
      sort_(owner, "sort_mean_distances.comp"),
      pack_(owner, "pack_mean_distances.comp") {}

void MeanDistances::plan(bool moves, uint32_t raysPerSurfel) {
    moves_ = moves;
    raysPerSurfel_ = raysPerSurfel;
    sort_.compileIf(moves);
    if (moves) measure_.define({{"KEEPS_HITS", "1"}});
}

void MeanDistances::begin(Device& device, const Surfels& surfels, const SurfelsByVoxel& byVoxel) {
    inverseDistances_ =
        LargeBuffer(device, "inverse distances of surfels", std::max(byVoxel.sortedCount, 1u) * sizeof(float));
    surfelCount_ = uint32_t(surfels.count);
    if (moves_) ensureSize(sums_, device, "sums of inverse distances", std::max(surfelCount_, 1u) * sizeof(uint32_t));
}

void MeanDistances::measure(PassContext& context, const SurfelsByVoxel& byVoxel, const Buffer& hits,
                            const LargeBuffer& keptHits, float voxelSize, uint32_t first, uint32_t count) const {
    context.dispatch(measure_, count,
                     {ifUsed({"hits", hits}),
                      ifUsed({"LinkHitsRef", keptHits.ref()}),
                      ifUsed({"SortedIndicesRef", byVoxel.sortedIndices.ref()}),
                      ifUsed({"InverseDistancesRef", inverseDistances_.ref()}),
                      ifUsed({"InverseSumsRef", sums_.ref()}),
                      {"firstSurfel", first},
                      {"batchSurfels", count},
                      {"raysPerSurfel", raysPerSurfel_},
                      ifUsed({"voxelSize", voxelSize})});
}

void MeanDistances::pack(PassContext& context, const SurfelsByVoxel& byVoxel, uint32_t voxels) {
    if (moves_)
        context.dispatch(sort_, surfelCount_,
                         {{"InverseSumsRef", sums_.ref()},
                          {"SortedIndicesRef", byVoxel.sortedIndices.ref()},
                          {"InverseDistancesRef", inverseDistances_.ref()},
                          {"surfelCount", surfelCount_},
                          {"raysPerSurfel", raysPerSurfel_}});
    context.dispatch(pack_, voxels,
                     {{"InverseDistancesRef", inverseDistances_.ref()},
                      {"PackedRef", byVoxel.packed.ref()},
                      {"surfelRanges", byVoxel.ranges},
                      {"voxels", voxels}});
    context.stream.finish();
    inverseDistances_ = {};
}

}  // namespace voxray
