#pragma once

#include "passes/common/view/gather_hits.h"
#include "passes/common/view/gbuffer.h"

namespace voxray {

/// Edge-avoiding wavelet filter over the irradiance of a g-buffer's texels: Dammertz et al. 2010 with a bound
/// of Ward et al. 1988 as its edge-stopping function (filter.comp, blocks.comp).
class IrradianceFilter {
 public:
    IrradianceFilter() = default;
    IrradianceFilter(PassSetup& setup, const GatherHits& hits);

    static uint64_t bytes(const GatherHits& hits);
    /// Where the irradiance (W/m²) of each texel and the number of rays that it stands for go, before run().
    const Buffer& gathered() const { return gathered_; }
    /// Where the sums over each block's rays go, before run(): gpu::GatherMoments each.
    const Buffer& moments() const { return moments_; }
    /// @return the filtered irradiance, as gathered().
    const Buffer& run(PassContext& context, const GBuffer& gbuffer, const GatherHits& hits, uint32_t levels,
                      float strictness) const;

 private:
    Program blocks_, guide_, filter_;
    Sampler sampler_;
    Buffer gathered_, filtered_, moments_, blockLight_, guides_;
};

}  // namespace voxray
