#pragma once

#include "passes/common/compute/prefix_sum.h"
#include "passes/common/lights/rsm.h"
#include "passes/inject/light_paths/light_emission.h"

namespace voxray {

/// First vertices of light paths out of reflective shadow maps, by importance: a texel is picked with a
/// probability in proportion to the flux that the point which it sees reflects. One set of points in the
/// square is warped by each light's maps, rows first and then within a row (Clarberg et al. 2005 warp level
/// by level), so that paths move with the flux and don't jump.
class RsmSampling {
 public:
    explicit RsmSampling(ProgramOwner& owner);

    void plan(PassPlan& plan, const Rsm& rsm);

    /// Writes a batch of the first rays of a source, with the hits that the maps hold, and what each carries:
    /// the power through its texel over the texel's probability and the number of paths. Where a source's
    /// maps are black its rays are inactive.
    struct Target {
        const Buffer& rays;   ///< Ray each.
        const Buffer& hits;   ///< Hit each.
        const Buffer& paths;  ///< gpu::LightPath each.
        LightEmission::Batch batch;
    };
    void emit(PassContext& context, const Rsm& rsm, size_t source, const Target& target) const;

 private:
    Kernel weigh_, pick_;
    PrefixSum prefixSum_;
    Buffer weights_;  ///< Of a source's texels, then what is before each.
};

}  // namespace voxray
