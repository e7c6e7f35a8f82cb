#pragma once

#include <string>

#include "passes/common/lights/light_sources.h"
#include "passes/common/surfels/surfel_light.h"
#include "passes/common/surfels/surfels.h"
#include "passes/common/voxels/face_irradiance.h"
#include "passes/common/voxels/voxel_accumulator.h"

namespace voxray {

/// Where the direct light of surfels comes from: measureDirect() or addDirect().
enum class DirectLight { ByShadowRays, Given };

/// The parameters of a pass whose light bounces by feedback.
struct FeedbackParams : WriteParams {
    uint32_t raysPerPoint = 1;
    uint32_t bounces = 8;
    static constexpr auto schema() {
        return std::tuple_cat(
            WriteParams::schema(),
            std::tuple{field("rays_per_point", &FeedbackParams::raysPerPoint,
                             "Gather rays from each point in each iteration.", 1u, 1024u),
                       field("bounces", &FeedbackParams::bounces, "Bounces of light.", 0u, 32u)});
    }
};

/// Light of surfels into voxels: their direct irradiance is merged; then, one bounce an iteration, rays from
/// every surfel find what reflects light to it. In the first iteration that is direct light, measured at the
/// hits by shadow rays: it differs most within a voxel (a sill in the sun next to a dark floor), and a
/// voxel's mean of it would lead light through walls. Later iterations read at their hits the indirect light
/// that the one before left in the voxels. Source: radiosity by iteration, Goral et al. 1984.
class SurfelFeedback {
 public:
    /// Describes the memory, the result's included. @param lightSamples shadow rays from each point to the
    /// emissive surfaces, and to the environment. @throws Error naming `pass` for what the device can't do.
    void plan(PassPlan& plan, const std::string& pass, const FeedbackParams& params, DirectLight direct,
              uint32_t lightSamples, const SurfaceVoxels& voxels);
    void prepare(PassSetup& setup);

    /// Allocates the result and clears the sums.
    void begin(PassContext& context, const SurfaceVoxels& voxels, const std::vector<LightSource>& sources,
               VoxelIrradiance& irradiance);
    /// Leaves the direct irradiance of a chunk's surfels in their voxels, measured by shadow rays.
    void measureDirect(PassContext& context, const Surfels::Chunk& chunk,
                       const std::vector<LightSource>& sources, uint32_t seed);
    /// Leaves direct irradiance that was measured otherwise. @param direct W/m², 4 floats each.
    void addDirect(PassContext& context, const Surfels::Chunk& chunk, const Buffer& direct) const;
    /// Fills the result once all chunks' direct light was added. @throws Error where there was none.
    void finish(PassContext& context, const SurfaceVoxels& voxels, const Surfels& surfels,
                const std::vector<LightSource>& sources, uint32_t seed, const VoxelIrradiance& irradiance);

 private:
    void bounce(PassContext& context, const SurfaceVoxels& voxels, const Surfels& surfels,
                const std::vector<LightSource>& sources, uint32_t seed, const VoxelIrradiance& irradiance);
    /// Faces without surfels take the mean of the voxels around them.
    void fillUnknown(PassContext& context, const SurfaceVoxels& voxels,
                     const VoxelIrradiance& irradiance) const;
    /// Traces a ray from each surfel of a chunk.
    void trace(PassContext& context, const Surfels::Chunk& chunk, uint32_t ray, uint32_t seed) const;
    void firstBounce(PassContext& context, const Surfels::Chunk& chunk, uint32_t ray,
                     const std::vector<LightSource>& sources, uint32_t seed) const;
    void laterBounce(PassContext& context, const Surfels::Chunk& chunk, const SurfaceVoxels& voxels) const;

    FeedbackParams params_;
    uint32_t lightSamples_ = 1;
    bool sendsShadowRays_ = true;
    float typicalIrradiance_ = 0;  ///< W/m²
    VoxelAccumulator direct_, indirect_;
    SurfelLight light_;
    Program write_, gather_, hitSurfels_, firstBounce_, feedback_, add_, fillUnknown_;
    FaceIrradiance faces_;
    Buffer rays_, hits_, surfelsAtHits_, measured_;
    LargeBuffer bounce_;  ///< Flux of one bounce.
};

}  // namespace voxray
