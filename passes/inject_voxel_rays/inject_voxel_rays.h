#pragma once

#include <optional>

#include "passes/common/surfels/surfel_feedback.h"
#include "passes/common/surfels/surfel_paths.h"
#include "passes/common/view/gather_hits.h"
#include "passes/common/view/gbuffer.h"

namespace voxray {

/// Rays from the voxels' surfaces: shadow rays to the lights, and gather rays whose hits read what the last
/// iteration left in the voxels, one bounce of light an iteration. With `demand`, just the faces that the
/// frame's gather rays will read are lit, each by its own short paths. Source: Magalhães 2020, section 6.1;
/// radiosity by iteration: Goral et al. 1984.
class InjectVoxelRays final : public Pass {
 public:
    static constexpr const char* kName = "inject_voxel_rays";
    static constexpr const char* kHelp =
        "Shadow rays and gather rays from points on the voxels' surfaces (place_surfels); bounces by "
        "feedback "
        "of the voxels' "
        "own light. Biased by: voxel size. Noisy by: points, rays. Leaves unlit: nothing, or with demand: "
        "true "
        "all that trace_gather_rays (which must come before) does not ask for.";
    struct Params : FeedbackParams {
        uint32_t lightSamples = 1;
        bool demand = false;
        static constexpr auto schema() {
            return std::tuple_cat(
                FeedbackParams::schema(),
                std::tuple{
                    field("light_samples", &Params::lightSamples,
                          "Shadow rays from each point to the emissive surfaces, and to the environment.", 1u,
                          256u),
                    field("demand", &Params::demand,
                          "Light only the faces that trace_gather_rays asks for, in each frame, by `rays` "
                          "paths from "
                          "each point.")});
        }
    };

    explicit InjectVoxelRays(const Params& params) : params_(params) {}
    Phase phase() const override { return params_.demand ? Phase::Frame : Phase::Build; }
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    SurfelPaths::Settings paths() const {
        return {params_.write, Surfels::kChunk, params_.bounces, params_.lightSamples, false};
    }
    void lightAsked(PassContext& context, uint32_t seed);
    void lightAll(PassContext& context, uint32_t seed);

    Params params_;
    Port<SurfaceVoxels> voxels_;
    Port<Surfels> surfels_;
    Port<GBuffer> gbuffer_;
    Port<GatherHits> hits_;
    Port<VoxelIrradiance> irradiance_;
    std::vector<LightSource> sources_;

    // With demand.
    VoxelAccumulator direct_, indirect_;
    SurfelPaths surfelPaths_;
    Program mark_, select_;
    Buffer count_, asked_;
    Sampler sampler_;

    // Without.
    std::optional<SurfelLight> light_;
    SurfelFeedback feedback_;
    Buffer surfelDirect_;
};

}  // namespace voxray
