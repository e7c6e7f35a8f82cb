#pragma once

#include "passes/common/surfels/surfel_injection.h"
#include "passes/common/surfels/surfels.h"

namespace voxray {

/// Rays from the voxels' surfaces: shadow rays to the lights, and paths that bring indirect light. Source:
/// Magalhães 2020, section 6.1, whose rays read the light of the last frame in the voxels that they hit.
class InjectVoxelRays final : public Pass {
 public:
    static constexpr const char* kName = "inject_voxel_rays";
    static constexpr const char* kHelp =
        "Shadow rays and paths from points on the voxels' surfaces (place_surfels). Biased by: voxel size. "
        "Noisy by: points_per_voxel, paths_per_point. Leaves unlit: nothing.";
    struct Params : SurfelParams {
        uint32_t lightSamples = 1;
        static constexpr auto schema() {
            return std::tuple_cat(
                SurfelParams::schema(),
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
    SurfelInjection injection_;
};

}  // namespace voxray
