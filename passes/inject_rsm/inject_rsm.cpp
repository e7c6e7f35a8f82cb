#include "passes/inject_rsm/inject_rsm.h"

#include <algorithm>

#include "passes/common/compute/dispatch.h"
#include "passes/common/compute/random_seed.h"

namespace voxray {
namespace {

constexpr uint32_t kMaxBatchTexels = 1u << 20;  // Bounds the memory of rays and what they carry to 108 MiB.

struct RsmRaysPush {
    gpu::LightView view;
    uint32_t light;
    uint32_t resolution;
    uint32_t firstTexel;
    uint32_t texels;
};

}  // namespace

void InjectRsm::declare(PassBuilder& builder) {
    voxels_ = builder.read<SurfaceVoxels>("voxels", "surface voxels to light");
    irradiance_ = builder.write<VoxelIrradiance>("irradiance", "light that arrives at the voxels' surfaces");
}

void InjectRsm::plan(PassPlan& plan) {
    plan.get(irradiance_).lightBounces = params_.lastBounce();
    const std::vector<LightSource> sources = requireViewpoints(*plan.frame.scene, kName);
    map_.plan(plan, params_.rsmResolution);
    paths_.plan(plan, kName, params_, std::min(texels(), kMaxBatchTexels), plan.get(voxels_), sources);
}

void InjectRsm::prepare(PassSetup& setup) {
    map_.prepare(setup);
    makeRays_ = makeComputeProgram(setup.device, setup.compiler.compile("passes/inject_rsm/rsm_rays.comp"));
    paths_.prepare(setup);
}

void InjectRsm::record(PassContext& context) {
    const SurfaceVoxels& voxels = context.get(voxels_);
    const SceneState& state = *context.frame.scene;
    const std::vector<LightSource> sources = lightSources(state);
    paths_.begin(context, voxels, sources);
    for (uint32_t s = 0; s < sources.size(); ++s) {
        const uint32_t seed = randomSeed(context.frame, s);
        const std::vector<gpu::LightView> views = lightViews(state.lights[sources[s].light], state.geometry);
        for (uint32_t v = 0; v < views.size(); ++v) {
            map_.draw(context, views[v]);

            // Texels are light rays with known hits.
            for (uint32_t first = 0; first < texels(); first += kMaxBatchTexels) {
                const uint32_t batch = std::min(kMaxBatchTexels, texels() - first);
                context.stream.dispatch(
                    makeRays_,
                    context.scene.bindings({{"rays", paths_.rays()},
                                            {"hits", paths_.hits()},
                                            {"paths", paths_.paths()},
                                            {"seen", map_.image()}}),
                    RsmRaysPush{views[v], sources[s].light, params_.rsmResolution, first, batch},
                    linearGroups(batch));
                paths_.follow(context, voxels, {seed, v * texels() + first, batch, true});
            }
        }
    }
    paths_.finish(context, voxels, context.get(irradiance_));
}

}  // namespace voxray
