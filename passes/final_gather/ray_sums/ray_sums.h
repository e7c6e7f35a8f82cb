#pragma once

#include "passes/common/filter/noisy_irradiance.h"
#include "passes/common/view/gather_hits.h"

namespace voxray {

/// Irradiance of texels, and moments of blocks, of what gather rays bring.
class RaySums {
 public:
    explicit RaySums(ProgramOwner& owner)
        : averageTexels_(owner, "average_texels.comp"),
          scatterRays_(owner, "scatter_rays.comp"),
          sumMoments_(owner, "sum_moments.comp") {}

    /// Describes the irradiance of gather rays, and their moments where `noisy` is read or the pass needs them itself.
    void plan(PassPlan& plan, const GatherHits& hits, uint32_t samples, NoisyIrradiance& noisy,
              bool needsMoments = false);
    /// Means over the rays of a batch's texels; batches in order. @param light of the batch, as GatherLight::light.
    void average(PassContext& context, const GatherHits& hits, uint32_t batch, const Buffer& light,
                 const Image& irradiance) const;
    /// Moments over the rays of a batch's blocks.
    void addMoments(PassContext& context, const GatherHits& hits, uint32_t batch, const Buffer& light,
                    const Buffer& moments) const;
    /// Both; moments where `noisy` is read.
    void add(PassContext& context, const GatherHits& hits, uint32_t batch, const Buffer& light,
             const NoisyIrradiance& noisy) const;

    /// @throws Error where texels have no ray, for a pass that writes an image without a filter.
    static void requireRays(const GatherHits& hits, const char* pass);

 private:
    Kernel averageTexels_, scatterRays_, sumMoments_;
};

}  // namespace voxray
