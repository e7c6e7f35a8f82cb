#pragma once

#include <vector>

#include "passes/common/lights/shadow_map.h"
#include "passes/surfels/surfels.h"

namespace voxray {

/// Direct irradiance of surfels by shadow maps, one view of a light after the other, with percentage-closer
/// filtering over 2x2 texels. Source: Arnebäck 2017, where voxels are tested; filtering: Reeves et al. 1987.
class ShadowMapLight {
 public:
    explicit ShadowMapLight(ProgramOwner& owner);

    /// @param resolution texels along an edge.
    void plan(PassPlan& plan, uint32_t resolution);
    /// @param sources punctual lights. @return irradiance of the surfels of each chunk, W/m², 4 floats each.
    std::vector<Buffer> measure(PassContext& context, const std::vector<LightSource>& sources,
                                const Surfels& surfels) const;

 private:
    static constexpr uint32_t kCubeFaces = 6;

    uint32_t resolution_ = 0;
    Kernel test_;
    ShadowMap map_;
};

}  // namespace voxray
