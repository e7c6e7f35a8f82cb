#pragma once

#include "passes/common/radiance/radiance_voxels.h"
#include "passes/common/view/gbuffer.h"

namespace voxray {

/// Light that specular lobes reflect: from each texel of the g-buffer a cone for each stratum of its lobe.
/// Docs: docs/cone-tracing.md.
class SpecularCones {
 public:
    /// @param strata of a lobe: 1, 7 or 19.
    void plan(PassPlan& plan, const GBuffer& gbuffer, uint32_t strata);
    void prepare(PassSetup& setup, const RadianceVoxels& radiance);
    void record(PassContext& context, const GBuffer& gbuffer, const RadianceVoxels& radiance) const;
    /// RGBA32F: radiance reflected, W/(m² sr); the fraction of light that is left to the diffuse lobe below.
    const Image& reflected() const { return reflected_; }

 private:
    uint32_t strata_ = 0;
    Program trace_;
    Sampler sampler_;
    Buffer table_;
    Image reflected_;
};

}  // namespace voxray
