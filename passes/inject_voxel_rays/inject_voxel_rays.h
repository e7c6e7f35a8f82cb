#pragma once

#include "passes/common/surfels/surfel_feedback.h"

namespace voxray {

/// Rays from the voxels' surfaces: shadow rays to the lights; gather rays, one bounce of light an iteration,
/// with shadow rays at the hits of the first, and of the others what the last iteration left in the voxels.
/// Source: Magalhães 2020, section 6.1; radiosity by iteration: Goral et al. 1984.
class InjectVoxelRays final : public Pass {
 public:
    static constexpr const char* kName = "inject_voxel_rays";
    static constexpr const char* kHelp =
        "Shadow rays and gather rays from points on the voxels' surfaces (place_surfels); bounces by "
        "feedback "
        "of the voxels' own light. Biased by: voxel size. Noisy by: points_per_voxel, "
        "rays_per_point. Leaves unlit: nothing.";
    struct Params : FeedbackParams {
        uint32_t lightSamples = 1;
        static constexpr auto schema() {
            return std::tuple_cat(
                FeedbackParams::schema(),
                std::tuple{
                    field("light_samples", &Params::lightSamples,
                          "Shadow rays from each point to the emissive surfaces, and to the environment.", 1u,
                          256u)});
        }
    };

    explicit InjectVoxelRays(const Params& params) : params_(params) {}
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    Params params_;
    Port<const SurfaceVoxels> voxels_;
    Port<const Surfels> surfels_;
    Port<VoxelIrradiance> irradiance_;
    std::vector<LightSource> sources_;
    SurfelFeedback feedback_;
};

}  // namespace voxray
