#pragma once

#include <vector>

#include "graph/pass.h"
#include "passes/common/compute/compaction.h"
#include "passes/common/compute/prefix_sum.h"

namespace voxray {

/// Points, by number, in ascending order.
struct SelectedPoints {
    Buffer points;
    uint32_t count = 0;
};

/// Selects the points of kept faces that a frame updates: by priority (prioritize_points.comp), within a budget of
/// rays.
class PointSelection {
 public:
    explicit PointSelection(ProgramOwner& owner);

    /// What is selected from.
    struct Candidates {
        std::vector<Binding> kept;  ///< Of the faces and their points, each ifUsed().
        uint32_t faces, pointsPerFace;
        uint32_t frame;
        uint32_t raysOfNew, raysAgain;  ///< Of a point that is lit for the first time or exchanged, and of others.
    };
    /// @param budget rays. Waits for the device.
    void select(PassContext& context, const Candidates& candidates, uint32_t budget);
    void selectNone() { again_.count = added_.count = 0; }
    /// Points whose direct light is measured again.
    const SelectedPoints& again() const { return again_; }
    /// Points that are lit for the first time, or exchanged.
    const SelectedPoints& added() const { return added_; }

 private:
    /// Bins all updates by priority. @return the rays of each bin.
    std::vector<uint32_t> prioritize(PassContext& context, const Candidates& candidates);

    Kernel meanSquare_, prioritize_, costs_, select_;
    PrefixSum prefixSum_;
    Compaction compaction_;
    SelectedPoints again_, added_;
    Buffer meanSquareOfFaces_, bins_, raysOfBins_, costsBefore_, blockSums_, oldFlags_, newFlags_;
};

}  // namespace voxray
