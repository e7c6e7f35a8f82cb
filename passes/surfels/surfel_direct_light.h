#pragma once

#include "graph/pass.h"
#include "passes/common/lights/light_sources.h"
#include "passes/common/lights/pane_transmittance.h"
#include "passes/surfels/surfel_types.h"

namespace voxray {

/// Direct irradiance of surfels by shadow rays: one to each punctual light, `samples` to the emissive
/// surfaces and as many to the environment.
class SurfelDirectLight {
 public:
    explicit SurfelDirectLight(ProgramOwner& owner);

    /// @param batch surfels in one call of measure(), at most.
    void plan(PassPlan& plan, uint32_t batch);
    /// Writes the irradiance, W/m², of the first `count` surfels to `direct`, 4 floats each.
    void measure(PassContext& context, const std::vector<LightSource>& sources, const Buffer& surfels,
                 uint32_t count, uint32_t samples, uint32_t seed, const Buffer& direct) const;

 private:
    Kernel aim_, add_;
    Buffer rays_, carried_, occluded_;
    PaneTransmittance paneTransmittance_;
};

}  // namespace voxray
