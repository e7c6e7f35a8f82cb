#include <vector>

#include "graph/registry.h"
#include "passes/common/compute/random_seed.h"
#include "passes/surfels/surfel_injection.h"
#include "passes/surfels/surfels.h"

namespace voxray {

/// Rays from the voxels' surfaces: shadow rays to the lights, and paths that bring indirect light. Source:
/// Magalhães 2020, section 6.1, whose rays read the light of the last frame in the voxels that they hit.
class InjectVoxelRays final : public Pass {
 public:
    static constexpr const char* kName = "inject_voxel_rays";
    static constexpr const char* kHelp =
        "Lights voxels by shadow rays and paths from their surfels. The surfels are points on the voxels' "
        "surfaces (place_surfels). Biased by: voxel size. Noisy by: points_per_voxel, paths_per_point. "
        "Leaves unlit: nothing.";
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

    void plan(PassPlan& plan) override {
        plan[irradiance_].lightBounces = params_.bounces;
        sources_ = requireLightSources(*plan.frame.scene, kName);
        injection_.plan(plan, kName, params_,
                        {Surfels::kChunk, true, params_.bounces > 0, params_.lightSamples}, plan[voxels_]);
    }
    void record(PassContext& context) override {
        const uint32_t seed = randomSeed(context.frame, context.frameIndex);
        const PathScene scene{context[voxels_], sources_};
        VoxelIrradiance& irradiance = context[irradiance_];
        injection_.begin(context, scene, irradiance);
        for (const Surfels::Chunk& chunk : context[surfels_].chunks)
            injection_.light(context, scene, chunk.surfels, chunk.count, params_, seed);
        injection_.finish(context, scene.voxels, irradiance);
        requireLight(context.stream, scene.voxels, irradiance, *context.frame.scene);
        injection_.fillUnknown(context, scene.voxels, irradiance);
    }

 private:
    const Params params_;
    In<SurfaceVoxels> voxels_{*this, "voxels", "surface voxels to light"};
    In<Surfels> surfels_{*this, "surfels", "points where irradiance is measured"};
    Out<VoxelIrradiance> irradiance_{*this, "irradiance", "light that arrives at the voxels' surfaces"};
    std::vector<LightSource> sources_;
    SurfelInjection injection_{*this};
};
VOXRAY_REGISTER_PASS(InjectVoxelRays);

}  // namespace voxray
