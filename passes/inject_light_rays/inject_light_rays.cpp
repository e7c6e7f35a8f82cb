#include "passes/inject_light_rays/inject_light_rays.h"

#include <algorithm>

#include "passes/common/compute/random_seed.h"

namespace voxray {
namespace {

constexpr uint32_t kMaxBatchRays = 1u << 20;  // Bounds the memory of rays and what they carry to 108 MiB.

}  // namespace

void InjectLightRays::declare(PassBuilder& builder) {
    voxels_ = builder.read<SurfaceVoxels>("voxels", "surface voxels to light");
    irradiance_ = builder.write<VoxelIrradiance>("irradiance", "light that arrives at the voxels' surfaces");
}

void InjectLightRays::plan(PassPlan& plan) {
    plan.get(irradiance_).lightBounces = params_.lastBounce();
    const std::vector<LightSource> sources = requireLightSources(*plan.frame.scene, kName);
    paths_.plan(plan, kName, params_, std::min(params_.raysPerLight, kMaxBatchRays), plan.get(voxels_),
                sources);
    emission_.plan(plan, std::min(params_.raysPerLight, kMaxBatchRays));
    plan.lightRays = uint64_t(params_.raysPerLight) * (params_.lastBounce() + 1) * sources.size();
}

void InjectLightRays::prepare(PassSetup& setup) {
    emission_.prepare(setup);
    paths_.prepare(setup);
}

void InjectLightRays::record(PassContext& context) {
    const SurfaceVoxels& voxels = context.get(voxels_);
    const std::vector<LightSource> sources = lightSources(*context.frame.scene);
    paths_.begin(context, voxels, sources);
    for (uint32_t s = 0; s < sources.size(); ++s) {
        const uint32_t seed = randomSeed(context.frame, s), rays = params_.raysPerLight;
        for (uint32_t first = 0; first < rays; first += kMaxBatchRays) {
            const uint32_t count = std::min(kMaxBatchRays, rays - first);
            emission_.emit(context, sources[s], {seed, rays, first, count}, paths_.rays(), paths_.paths());
            paths_.follow(context, voxels, {seed, first, count});
        }
    }
    paths_.finish(context, voxels, context.get(irradiance_));
}

}  // namespace voxray
