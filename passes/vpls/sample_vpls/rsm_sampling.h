#pragma once

#include "passes/common/compute/prefix_sum.h"
#include "passes/common/lights/rsm.h"
#include "passes/inject/light_paths/light_emission.h"

namespace voxray {

/// Importance sampling of reflective shadow maps, for the first vertices of light paths: a texel is sampled
/// in proportion to the flux that its point reflects. One point set in the unit square is warped by each
/// light's maps, rows first, then texels (compare Clarberg et al. 2005, hierarchical warping), so that paths
/// follow the flux continuously.
class RsmSampling {
 public:
    explicit RsmSampling(ProgramOwner& owner);

    void plan(PassPlan& plan, const Rsm& rsm);

    /// A batch of the first rays of a source, with their hits from the maps and the power that each carries:
    /// that of its texel over the texel's probability and the number of paths. Rays are inactive where a
    /// source's maps are black.
    struct Target {
        const Buffer& rays;   ///< Ray each.
        const Buffer& hits;   ///< Hit each.
        const Buffer& paths;  ///< gpu::LightPath each.
        LightEmission::Batch batch;
    };
    void emit(PassContext& context, const Rsm& rsm, size_t source, const Target& target) const;

 private:
    Kernel computeWeights_, sampleTexels_;
    PrefixSum prefixSum_;
    Buffer weights_;  ///< Of a source's texels, then their prefix sums.
};

}  // namespace voxray
