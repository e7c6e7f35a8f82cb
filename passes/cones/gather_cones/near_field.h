#pragma once

#include <array>
#include <vector>

#include "passes/common/view/gbuffer.h"
#include "passes/cones/radiance/radiance_voxels.h"
#include "passes/surfels/surfel_direct_light.h"

namespace voxray {

/// Diffuse cones that begin with a ray through the near field, where voxels are too coarse. At a hit direct
/// light is sampled by shadow rays and the path continues; without a hit the cone begins at the ray's end.
/// Source: the secondary gather of Jensen 2001, section 8.2. Docs: docs/cone-tracing.md.
class NearField {
 public:
    struct Settings {
        float voxels = 0;    ///< Length of the near field, in voxels of the finest level.
        uint32_t cones = 0;  ///< Per traced texel.
        uint32_t stride = 0;
        glm::uvec2 tracedExtent{};  ///< Traced texels: columns and rows.
        float width = 0;            ///< Of the cones from near hits, at unit distance.
    };

    explicit NearField(ProgramOwner& owner);

    void plan(PassPlan& plan, const RadianceVoxels& radiance, const Settings& settings);
    /// Writes the irradiance of the traced texels, W/m². @param cones coneSet() on the device.
    void record(PassContext& context, const GBuffer& gbuffer, const RadianceVoxels& radiance, const Buffer& cones,
                const Image& irradiance);

 private:
    /// Continues paths from near hits. @param range of the rays, m.
    void continuePaths(PassContext& context, const RadianceVoxels& radiance, float range, uint32_t batchSeed);

    Settings settings_;
    std::vector<LightSource> sources_;
    SurfelDirectLight hitLight_;
    Kernel generateRays_, resolveRays_, reflect_, continuePaths_, sumCones_;
    Buffer rays_, hits_, light_, count_, direct_;
    std::array<Buffer, 2> surfels_, continuations_;  ///< Near hits of this bounce and of the last one.
};

}  // namespace voxray
