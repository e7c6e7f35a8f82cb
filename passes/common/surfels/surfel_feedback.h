#pragma once

#include <string>

#include "passes/common/lights/light_sources.h"
#include "passes/common/surfels/surfels.h"
#include "passes/common/voxels/face_irradiance.h"
#include "passes/common/voxels/voxel_accumulator.h"

namespace voxray {

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
/// every surfel read at their hits what the last iteration left in the voxels. Source: radiosity by
/// iteration, Goral et al. 1984.
class SurfelFeedback {
 public:
    /// Describes the memory, the result's included. @throws Error naming `pass` for what the device can't do.
    void plan(PassPlan& plan, const std::string& pass, const FeedbackParams& params,
              const SurfaceVoxels& voxels);
    void prepare(PassSetup& setup);

    /// Allocates the result and clears the sums.
    void begin(PassContext& context, const SurfaceVoxels& voxels, const std::vector<LightSource>& sources,
               VoxelIrradiance& irradiance);
    /// Leaves the direct irradiance of a chunk's surfels in their voxels. @param direct W/m², 4 floats each.
    void addDirect(PassContext& context, const Surfels::Chunk& chunk, const Buffer& direct) const;
    /// Fills the result once all chunks' direct light was added. @throws Error where there was none.
    void finish(PassContext& context, const SurfaceVoxels& voxels, const Surfels& surfels, uint32_t seed,
                const VoxelIrradiance& irradiance);

 private:
    FeedbackParams params_;
    float typicalIrradiance_ = 0;  ///< W/m²
    VoxelAccumulator direct_, indirect_;
    Program write_, gather_, feedback_;
    FaceIrradiance faces_;
    Buffer rays_, hits_;
};

}  // namespace voxray
