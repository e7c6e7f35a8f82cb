#pragma once

#include <array>
#include <optional>
#include <vector>

#include "passes/common/filter/noisy_irradiance.h"
#include "passes/common/view/gbuffer.h"
#include "passes/cones/radiance/radiance_voxels.h"
#include "passes/path_trace/path_streams/path_streams.h"
#include "passes/surfels/surfel_direct_light.h"

namespace voxray {

/// How a cone finds what it sees.
enum class ConeVisibility { Voxels, Rays };
template <>
struct EnumNames<ConeVisibility> {
    static constexpr std::array names{std::pair{ConeVisibility::Voxels, "voxels"},
                                      std::pair{ConeVisibility::Rays, "rays"}};
};

/// What averages the residual.
enum class ResidualFilter { Mean, Apart };
template <>
struct EnumNames<ResidualFilter> {
    static constexpr std::array names{std::pair{ResidualFilter::Mean, "mean"},
                                      std::pair{ResidualFilter::Apart, "apart"}};
};

/// Diffuse cones with a ray along each one's axis. Through a near field, where voxels are too coarse: at a hit there
/// direct light is sampled by shadow rays and the path continues (the secondary gather of Jensen 2001, section 8.2).
/// Beyond it, up to what the cone sees or not (ConeVisibility). And for the residual: some rays go on as paths.
/// Docs: docs/cone-tracing.md.
class ConeRays {
 public:
    struct Settings {
        ConeVisibility visibility = ConeVisibility::Voxels;
        float nearVoxels = 0;       ///< Length of the near field, in voxels of the finest level; 0: none.
        float residual = 0;         ///< Probability that a ray goes on as a path; 0: none do.
        uint32_t bounces = 0;       ///< Of the paths, as PathTraceOptions has them.
        uint32_t cones = 0;         ///< Per traced texel.
        uint32_t stride = 0;        ///< Of traced texels.
        uint32_t samples = 0;       ///< Texels along an edge of a pixel.
        glm::uvec2 tracedExtent{};  ///< Traced texels: columns and rows.
        float width = 0;            ///< Of the cones from near hits, at unit distance.
    };

    /// Without a residual no path is traced.
    ConeRays(ProgramOwner& owner, bool hasResidual);

    /// @param residual to be described; null: it is added to what the cones find.
    void plan(PassPlan& plan, const RadianceVoxels& radiance, const Settings& settings, NoisyIrradiance* residual);
    /// Writes the irradiance of the traced texels, W/m². @param cones coneSet() on the device. @param residual as of
    /// plan().
    void record(PassContext& context, const GBuffer& gbuffer, const RadianceVoxels& radiance, const Buffer& cones,
                const Image& irradiance, const NoisyIrradiance* residual);

 private:
    void planNearField(PassPlan& plan, const RadianceVoxels& radiance, uint32_t batchCones);
    void planResidual(PassPlan& plan, NoisyIrradiance& residual);
    /// Sums the moments of texels over blocks.
    void sumMoments(PassContext& context, const GBuffer& gbuffer, const NoisyIrradiance& residual);
    void reportPaths(PassContext& context);
    /// Continues paths from near hits. @param range of the rays, m.
    void continuePaths(PassContext& context, const RadianceVoxels& radiance, float range, uint32_t batchSeed);
    /// Traces the paths of a batch, whose cones' rays and hits are known.
    void tracePaths(PassContext& context, const Bindings& batch, uint32_t firstTexel, uint32_t batchTexels,
                    uint32_t seed);
    /// Of a frame's directions: what rays see is noise, which frames and seeds average out. Without rays to the end
    /// directions stay as they are, since voxels change little within a stratum.
    glm::vec2 directionShift(uint32_t seed) const;
    bool hasNearField() const { return settings_.nearVoxels > 0; }

    Settings settings_;
    std::vector<LightSource> sources_;
    SurfelDirectLight hitLight_;
    Kernel generateRays_, resolveRays_, reflect_, continuePaths_, beginPaths_, addResiduals_, splitResiduals_,
        blockMoments_, sumCones_;
    std::optional<PathStreams> streams_;
    Buffer rays_, hits_, light_, count_, direct_, chosen_;
    Buffer texelMoments_;                            ///< gpu::RayMoments of the residual, by traced texel.
    std::array<Buffer, 2> surfels_, continuations_;  ///< Near hits of this bounce and of the last one.
};

}  // namespace voxray
