#include <algorithm>

#include "graph/registry.h"
#include "passes/common/compute/random_seed.h"
#include "passes/inject/light_paths/light_emission.h"
#include "passes/inject/light_paths/light_paths.h"

namespace voxray {

/// Light tracing: rays from every light deposit their power in the voxels that they hit, bounce after bounce.
/// The flux that a voxel's surfaces receive, over their area, is their mean irradiance, with no factor to
/// calibrate. Source: Magalhães 2020, section 3.3 (rays from the light). Flux over area instead of a mean of
/// deposits is ours: it is right where a light and a shadow, or several lights, share a voxel.
class InjectLightRays final : public Pass {
 public:
    static constexpr const char* kName = "inject_light_rays";
    static constexpr const char* kHelp =
        "Traces rays from every light, and deposits their power in the voxels hit. Then the rays bounce. Biased by: "
        "voxel size; write other than average; secondary: mirror, which takes every surface for a coloured mirror. "
        "Noisy by: rays_per_light. Leaves unlit: nothing that light reaches, given rays enough. "
        "With diffuse bounces all surfaces are Lambert surfaces of their base colour. "
        "Source: Magalhães 2020, section 3.3.";
    struct Params : LightPathParams {
        uint32_t raysPerLight = 1048576;
        static constexpr auto schema() {
            return std::tuple_cat(std::tuple{field("rays_per_light", &Params::raysPerLight,
                                                   "Rays from each punctual light; "
                                                   "all emissive surfaces together count as one light, "
                                                   "the environment as another.",
                                                   1u, 1u << 26)
                                                 .lessNoise()},
                                  LightPathParams::schema());
        }
    };

    explicit InjectLightRays(const Params& params) : params_(params) {}

    void plan(PassPlan& plan) override {
        plan[irradiance_].lightBounces = params_.lastBounce();
        const std::vector<LightSource> sources = requireLightSources(*plan.frame.scene, kName);
        const uint32_t batch = std::min(params_.raysPerLight, kMaxBatchRays);
        paths_.plan(plan, kName, batch, plan[voxels_], sources);
        emission_.plan(plan, batch);
        plan.lightRays = uint64_t(params_.raysPerLight) * (params_.lastBounce() + 1) * sources.size();
    }
    void record(PassContext& context) override {
        // Voxels that follow the camera are lit again where they or the scene have changed
        const uint64_t sceneVersion = context.frame.sceneVersion;
        if (!context.changed(voxels_) && sceneVersion_ == sceneVersion) return context.markOutputsUnchanged();
        sceneVersion_ = sceneVersion;
        const VoxelLevels& voxels = context[voxels_];
        const std::vector<LightSource> sources = lightSources(*context.frame.scene);
        paths_.begin(context, voxels, sources);
        for (uint32_t s = 0; s < sources.size(); ++s) {
            const uint32_t seed = randomSeed(context.frame, s), rays = params_.raysPerLight;
            for (uint32_t first = 0; first < rays; first += kMaxBatchRays) {
                const uint32_t count = std::min(kMaxBatchRays, rays - first);
                emission_.emit(context, sources[s], {seed, rays, first, count}, paths_.rays(), paths_.paths());
                paths_.trace(context, voxels, {seed, first, count});
            }
        }
        paths_.finish(context, voxels, context[irradiance_]);
    }

 private:
    static constexpr uint32_t kMaxBatchRays = 1u << 20;  ///< Bounds the memory of rays to 108 MiB.

    const Params params_;
    In<VoxelLevels> voxels_{*this, "voxels", "surface voxels to light"};
    Out<VoxelIrradiance> irradiance_{*this, "irradiance", "light that arrives at the voxels' surfaces"};
    LightEmission emission_{*this};
    LightPaths paths_{*this, params_};
    uint64_t sceneVersion_ = 0;  ///< Of the last injection.
};
VOXRAY_REGISTER_PASS(InjectLightRays);

}  // namespace voxray
