#pragma once

#include "graph/pass.h"

namespace voxray {

/// For a pass whose light ignores panes. @throws Error naming the pass where the scene has coloured ones.
void requireClearPanes(const SceneState& state, const std::string& pass);

/// Transmittance of the coloured panes (scene/panes.h) along rays. In scenes without such panes it does
/// nothing and takes no memory.
class PaneTransmittance {
 public:
    explicit PaneTransmittance(ProgramOwner& owner);

    /// @param rays maximum of one call of apply().
    void plan(PassPlan& plan, uint64_t rays);

    /// Multiplies the throughput of rays by the transmittance of all panes along them.
    /// @param throughput RGB of ray i: three floats from index i * `stride` on
    /// @param hits where rays end; nullptr: at their tMax
    void apply(PassContext& context, const Buffer& rays, const Buffer& throughput, uint32_t stride, uint32_t count,
               const Buffer* hits = nullptr) const;

 private:
    Kernel initRays_, initRaysAtHits_, transmit_;
    Buffer rays_, hits_, active_;
};

}  // namespace voxray
