#pragma once

#include "graph/pass.h"

namespace voxray {

/// @throws Error naming the pass where a scene has coloured panes: for one whose light can't take on colour.
void requireClearPanes(const SceneState& state, const std::string& pass);

/// What light loses to the colour of panes (scene/panes.h) that its rays cross. Does nothing where a scene
/// has no coloured panes, and takes no memory.
class PaneTransmittance {
 public:
    explicit PaneTransmittance(ProgramOwner& owner);

    /// @param rays of one call of apply(), at most.
    void plan(PassPlan& plan, uint64_t rays);

    /// Multiplies what rays carry by the transmittance of all panes on their way.
    /// @param carried what the i-th ray carries are the three floats from i * `stride` on
    /// @param hits where rays end; nullptr: at their tMax
    void apply(PassContext& context, const Buffer& rays, const Buffer& carried, uint32_t stride,
               uint32_t count, const Buffer* hits = nullptr) const;

 private:
    Kernel initRays_, initRaysAtHits_, cross_;
    Buffer rays_, hits_, active_;
};

}  // namespace voxray
