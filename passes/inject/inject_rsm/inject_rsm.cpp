#include <algorithm>
#include <vector>

#include "graph/registry.h"
#include "passes/common/compute/random_seed.h"
#include "passes/common/lights/rsm.h"
#include "passes/inject/light_paths/light_paths.h"

namespace voxray {

/// Rasterizes the scene from every light. Each texel is a light ray with a known first hit; bounces are
/// traced. Source: Dachsbacher and Stamminger 2005; Crassin et al. 2011, section 6 (injection into voxels).
class InjectRsm final : public Pass {
 public:
    static constexpr const char* kName = "inject_rsm";
    static constexpr const char* kHelp =
        "Lights voxels by a reflective shadow map (RSM) of each light. Rasterizes the scene from every light "
        "and deposits the light through each texel in the voxel of the point that the texel shows. "
        "Then rays bounce from there. Point lights take a cube of six views, spots one (wider than 90° across: "
        "the cube), directional lights one over the scene's bounding sphere. "
        "No emissive surfaces and no environment: they have no single viewpoint. "
        "Biased by: voxel size; rsm_resolution (texels larger than voxels leave gaps). "
        "Noisy by: bounces alone, of rays from each texel (rsm_resolution). Leaves unlit: "
        "what lies nearer to a light than 0.0001 of the scene's extent. Source: Dachsbacher and Stamminger 2005.";
    struct Params : LightPathParams {
        uint32_t rsmResolution = 768;
        static constexpr auto schema() {
            return std::tuple_cat(std::tuple{field("rsm_resolution", &Params::rsmResolution,
                                                   "Texels along an edge of each view.", 1u, 4096u)
                                                 .lessNoise()},
                                  LightPathParams::schema());
        }
    };

    explicit InjectRsm(const Params& params) : params_(params) {}
    void plan(PassPlan& plan) override;
    void record(PassContext& context) override;

 private:
    static constexpr uint32_t kMaxBatchTexels = 1u << 20;  ///< Bounds the memory of rays to 108 MiB.

    uint32_t texels() const { return params_.rsmResolution * params_.rsmResolution; }

    const Params params_;
    In<SurfaceVoxels> voxels_{*this, "voxels", "surface voxels to light"};
    Out<VoxelIrradiance> irradiance_{*this, "irradiance", "light that arrives at the voxels' surfaces"};
    RsmImage map_{*this};
    Kernel generateRays_{*this, "generate_light_rays.comp"};
    LightPaths paths_{*this, params_};
};

void InjectRsm::plan(PassPlan& plan) {
    plan[irradiance_].lightBounces = params_.lastBounce();
    const std::vector<LightSource> sources = requirePunctualLights(*plan.frame.scene, kName);
    map_.plan(plan, params_.rsmResolution);
    paths_.plan(plan, kName, std::min(texels(), kMaxBatchTexels), plan[voxels_], sources);
}

void InjectRsm::record(PassContext& context) {
    const SurfaceVoxels& voxels = context[voxels_];
    const SceneState& state = *context.frame.scene;
    const std::vector<LightSource> sources = lightSources(state);
    paths_.begin(context, voxels, sources);
    for (uint32_t s = 0; s < sources.size(); ++s) {
        const uint32_t seed = randomSeed(context.frame, s);
        const std::vector<gpu::LightView> views = lightViews(state.lights[sources[s].light], state.geometry);
        for (uint32_t v = 0; v < views.size(); ++v) {
            map_.draw(context, views[v]);
            for (uint32_t first = 0; first < texels(); first += kMaxBatchTexels) {
                const uint32_t batch = std::min(kMaxBatchTexels, texels() - first);
                context.dispatch(generateRays_, batch,
                                 {context.scene,
                                  {"rays", paths_.rays()},
                                  {"hits", paths_.hits()},
                                  {"paths", paths_.paths()},
                                  {"rsm", map_.image()},
                                  {"view", views[v]},
                                  {"light", sources[s].light},
                                  {"resolution", params_.rsmResolution},
                                  {"firstTexel", first},
                                  {"texels", batch}});
                paths_.trace(context, voxels, {seed, v * texels() + first, batch, true});
            }
        }
    }
    paths_.finish(context, voxels, context[irradiance_]);
}

VOXRAY_REGISTER_PASS(InjectRsm);

}  // namespace voxray
