#include "passes/cache/hit_faces/kept/point_selection.h"

#include "passes/cache/hit_faces/kept/kept_types.h"
#include "passes/cache/hit_faces/point_batch.h"
#include "passes/common/compute/bit_words.h"

namespace voxray {

PointSelection::PointSelection(ProgramOwner& owner)
    : meanSquare_(owner, "mean_square.comp"),
      prioritize_(owner, "prioritize_points.comp"),
      costs_(owner, "cost_at_threshold.comp"),
      select_(owner, "select_points.comp"),
      prefixSum_(owner, PrefixSum::Input::Uints),
      compaction_(owner) {}

std::vector<uint32_t> PointSelection::prioritize(PassContext& context, const Candidates& candidates) {
    const uint32_t points = candidates.faces * candidates.pointsPerFace;
    grow(meanSquareOfFaces_, context, "mean square of faces", sizeof(float), 0);
    grow(bins_, context, "bins of points", points * sizeof(uint32_t), 0);
    grow(raysOfBins_, context, "rays of bins", PRIORITY_BINS * sizeof(uint32_t), 0);
    context.dispatch(meanSquare_, 1,
                     {candidates.kept, {"meanSquare", meanSquareOfFaces_}, {"faces", candidates.faces}});
    context.stream.fill(raysOfBins_, 0);
    context.dispatch(prioritize_, candidates.faces,
                     {candidates.kept,
                      {"meanSquare", meanSquareOfFaces_},
                      {"bins", bins_},
                      {"raysOfBins", raysOfBins_},
                      {"faces", candidates.faces},
                      {"pointsPerFace", candidates.pointsPerFace},
                      {"frame", candidates.frame},
                      {"raysOfNew", candidates.raysOfNew},
                      {"raysAgain", candidates.raysAgain}});
    return context.stream.readAs<uint32_t>(raysOfBins_, PRIORITY_BINS);
}

void PointSelection::select(PassContext& context, const Candidates& candidates, uint32_t budget) {
    // Find the bin in which the budget ends
    const std::vector<uint32_t> rays = prioritize(context, candidates);
    uint32_t threshold = PRIORITY_BINS - 1, rest = budget;
    for (; threshold > 0 && rays[threshold] <= rest; --threshold) rest -= rays[threshold];

    // Of the updates in that bin, take the first ones
    const uint32_t points = candidates.faces * candidates.pointsPerFace;
    const auto words = uint32_t(bitWords(points));
    grow(costsBefore_, context, "rays of points", points * sizeof(uint32_t), 0);
    grow(blockSums_, context, "prefix sum blocks", PrefixSum::scratchBytes(points), 0);
    grow(oldFlags_, context, "points measured again", words * sizeof(uint32_t), 0);
    grow(newFlags_, context, "new points", words * sizeof(uint32_t), 0);
    const std::vector<Binding> costs{{"bins", bins_},
                                     {"points", points},
                                     {"threshold", threshold},
                                     {"raysOfNew", candidates.raysOfNew},
                                     {"raysAgain", candidates.raysAgain}};
    context.dispatch(costs_, points, {candidates.kept, costs, {"rays", costsBefore_}});
    prefixSum_.record(context.stream, costsBefore_, costsBefore_, blockSums_, points);
    for (const Buffer* flags : {&oldFlags_, &newFlags_}) context.stream.fill(*flags, 0);
    context.dispatch(select_, points,
                     {candidates.kept,
                      costs,
                      {"raysBefore", costsBefore_},
                      {"newPoints", newFlags_},
                      {"oldPoints", oldFlags_},
                      {"rest", rest}});

    // List them
    for (SelectedPoints* selected : {&again_, &added_})
        grow(selected->points, context, "selected points", points * sizeof(uint32_t), 0);
    again_.count = compaction_.run(context.stream, oldFlags_, again_.points, words);
    added_.count = compaction_.run(context.stream, newFlags_, added_.points, words);
}

}  // namespace voxray
