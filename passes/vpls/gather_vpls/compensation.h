#pragma once

#include "passes/common/compute/compaction.h"
#include "passes/surfels/surfel_light.h"
#include "passes/vpls/gather_vpls/vpl_light.h"

namespace voxray {

/// The light that a bound on virtual point lights takes away: rays by cosine to what is nearer than the
/// bound, each weighted by the fraction that is missing at its distance. What is reflected there is direct
/// light by shadow rays, light of virtual point lights within the same bound, and what that takes away,
/// found in the same way. Source: Kollig and Keller 2004, "Illumination in the Presence of Weak
/// Singularities", section 4.
class VplCompensation {
 public:
    struct Settings {
        uint32_t rays;             ///< Of each texel.
        uint32_t bounces;          ///< Of light, among them the one at the end of each ray.
        float minDistanceSquared;  ///< m²: the bound, positive.
    };

    explicit VplCompensation(ProgramOwner& owner);

    /// @param texels of the G-buffer.
    void plan(PassPlan& plan, const Settings& settings, glm::uvec2 texels);
    /// Adds to `target` what VplLight::addToTexels() leaves out.
    void record(PassContext& context, const Vpls& vpls, const VplLight& light,
                const VplLight::Visibility& visibility, const GBuffer& gbuffer, const VplTarget& target);

 private:
    /// Traces a ray from each of `count` surfels. @return the number of surfels that they hit.
    uint32_t step(PassContext& context, uint32_t count, uint32_t seed);

    Settings settings_{};
    std::vector<LightSource> sources_;
    SurfelLight direct_;
    Kernel begin_, aim_, flag_, hit_, add_;
    Compaction compaction_;
    struct Ends {
        Buffer surfels, faceNormals;
    };
    Ends from_, to_;
    Buffer rays_, hits_, flags_, list_, arriving_;
};

}  // namespace voxray
