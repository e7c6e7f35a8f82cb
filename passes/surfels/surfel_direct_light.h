#pragma once

#include "graph/pass.h"
#include "passes/common/lights/light_sources.h"
#include "passes/common/lights/pane_transmittance.h"
#include "passes/surfels/surfel_types.h"

namespace voxray {

/// Direct irradiance of surfels by shadow rays: one to each punctual light, `samples` to the emissive
/// surfaces and as many to the environment. More than kExactLights point and spot lights are sampled with the emissive
/// surfaces.
class SurfelDirectLight {
 public:
    explicit SurfelDirectLight(ProgramOwner& owner);

    /// @param maxSurfels in one call of measure().
    void plan(PassPlan& plan, uint32_t maxSurfels);
    /// Writes the irradiance of `count` surfels to `direct`, W/m², 4 floats each.
    void measure(PassContext& context, const std::vector<LightSource>& sources, const Buffer& surfels, uint32_t count,
                 uint32_t samples, uint32_t seed, const Buffer& direct) const;

 private:
    Kernel generateRays_, accumulate_;
    Buffer rays_, contributions_, occluded_;
    PaneTransmittance paneTransmittance_;
};

}  // namespace voxray
