#pragma once

#include <array>
#include <vector>

#include "passes/common/view/gbuffer.h"
#include "passes/cones/radiance/radiance_voxels.h"
#include "passes/surfels/surfel_light.h"

namespace voxray {

/// Diffuse cones whose first part is a ray: within that near field nothing is read out of voxels. Where the
/// ray hits, direct light is measured by shadow rays and a ray goes on, as a path does; where it hits
/// nothing, the cone begins at its end. Source: the secondary gather of Jensen 2001, section 8.2. Docs:
/// docs/cone-tracing.md.
class NearField {
 public:
    struct Settings {
        float voxels = 0;    ///< Length of the near field, in voxels of the finest level.
        uint32_t cones = 0;  ///< Of each traced texel.
        uint32_t stride = 0;
        glm::uvec2 places{};  ///< Traced texels, by columns and rows.
        float width = 0;      ///< Of the cones that go on from near hits, at unit distance.
    };

    explicit NearField(ProgramOwner& owner);

    void plan(PassPlan& plan, const RadianceVoxels& radiance, const Settings& settings);
    /// Writes the irradiance of the traced texels, W/m². @param cones the set, as shaders have it.
    void record(PassContext& context, const GBuffer& gbuffer, const RadianceVoxels& radiance,
                const Buffer& cones, const Image& irradiance);

 private:
    /// From near hits on. @param range of the rays, m.
    void follow(PassContext& context, const RadianceVoxels& radiance, float range, uint32_t batchSeed);

    Settings settings_;
    std::vector<LightSource> sources_;
    SurfelLight hitLight_;
    Kernel aim_, first_, reflect_, goOn_, sum_;
    Buffer rays_, hits_, light_, count_, direct_;
    std::array<Buffer, 2> surfels_, goesOn_;  ///< Of near hits, and of those one step before.
};

}  // namespace voxray
