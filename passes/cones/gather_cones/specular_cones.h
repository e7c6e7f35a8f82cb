#pragma once

#include "passes/common/view/gbuffer.h"
#include "passes/common/view/specular_lobes.h"
#include "passes/cones/radiance/radiance_voxels.h"

namespace voxray {

/// Specular reflection: for each texel of the g-buffer a cone for each stratum of its lobe.
/// Docs: docs/cone-tracing.md.
class SpecularCones {
 public:
    explicit SpecularCones(ProgramOwner& owner);

    /// @param strata per lobe: 1, 7 or 19. @param reflected SpecularLobes::reflected, to be described.
    void plan(PassPlan& plan, const GBuffer& gbuffer, const RadianceVoxels& radiance, uint32_t strata,
              Image& reflected);
    /// Fills the table of lobes.
    void prepare(PassSetup& setup) const;
    void record(PassContext& context, const GBuffer& gbuffer, const RadianceVoxels& radiance,
                const Image& reflected) const;

 private:
    uint32_t strata_ = 0;
    Kernel fillTable_, trace_;
    Buffer table_;
};

}  // namespace voxray
