#pragma once

#include <vector>

#include "passes/common/lights/shadow_map.h"
#include "passes/surfels/surfels.h"

namespace voxray {

/// Direct irradiance of surfels by shadow maps: a depth view of the scene from every light is rasterised, and
/// surfels are tested against it, with percentage-closer filtering over 2x2 texels. Source: Arnebäck 2017
/// tests voxels against a shadow map as they are voxelized; filtering: Reeves et al. 1987.
class ShadowMapLight {
 public:
    explicit ShadowMapLight(ProgramOwner& owner);

    /// @param resolution texels a side.
    void plan(PassPlan& plan, uint32_t resolution);
    /// @param sources punctual ones alone. @return W/m² of each chunk's surfels, 4 floats each.
    std::vector<Buffer> measure(PassContext& context, const std::vector<LightSource>& sources,
                                const Surfels& surfels) const;

 private:
    static constexpr uint32_t kCubeFaces = 6;

    uint32_t resolution_ = 0;
    Kernel test_;
    ShadowMap map_;
};

}  // namespace voxray
