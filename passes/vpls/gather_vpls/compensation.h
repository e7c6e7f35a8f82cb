#pragma once

#include "passes/common/compute/compaction.h"
#include "passes/surfels/surfel_direct_light.h"
#include "passes/vpls/gather_vpls/vpl_gather.h"

namespace voxray {

/// Bias compensation (Kollig and Keller 2004, "Illumination in the Presence of Weak Singularities", section
/// 4): restores the light that the bound on the geometry term takes away. Cosine-distributed rays as long as
/// the bound, each weighted by the fraction that is missing at its distance. A hit reflects direct light, by
/// shadow rays, and virtual lights within the same bound; what that bound takes away there is restored by the
/// next ray of the path.
class VplCompensation {
 public:
    struct Settings {
        uint32_t raysPerTexel;
        uint32_t bounces;          ///< Of light, the one at the end of each ray included.
        float minDistanceSquared;  ///< m²: the bound, positive.
    };

    explicit VplCompensation(ProgramOwner& owner);

    /// @param texels of the G-buffer.
    void plan(PassPlan& plan, const Settings& settings, glm::uvec2 texels);
    /// Adds to `target` what VplGather::gatherAtTexels() leaves out.
    void record(PassContext& context, const Vpls& vpls, const VplGather& vplGather,
                const VplGather::Visibility& visibility, const GBuffer& gbuffer, const VplTarget& target);

 private:
    /// Traces a ray from each of `count` surfels, and makes the surfels at their hits current. @return the
    /// number of hits.
    uint32_t traceBounce(PassContext& context, uint32_t count, uint32_t seed);

    Settings settings_{};
    std::vector<LightSource> sources_;
    SurfelDirectLight directLight_;
    Kernel initSurfels_, generateRays_, flagHits_, surfelsAtHits_, accumulate_;
    Compaction compaction_;
    struct PathVertices {
        Buffer surfels, faceNormals;
    };
    PathVertices current_, next_;
    Buffer rays_, hits_, flags_, hitRays_, surfelIrradiance_;
};

}  // namespace voxray
