#include "passes/inject_light_rays/inject_light_rays.h"

#include <algorithm>

#include "passes/common/compute/dispatch.h"
#include "passes/common/compute/random_seed.h"

namespace voxray {
namespace {

constexpr uint32_t kMaxBatchRays = 1u << 20;  // Bounds the memory of rays and what they carry to 108 MiB.

struct EmitPush {
    uint32_t kind;
    uint32_t light;
    uint32_t firstRay;
    uint32_t batchRays;
    uint32_t totalRays;
    uint32_t seed;
    uint32_t emitterCount;
    glm::vec3 sceneCenter;
    float sceneRadius;
};

}  // namespace

void InjectLightRays::declare(PassBuilder& builder) {
    voxels_ = builder.read<SurfaceVoxels>("voxels", "surface voxels to light");
    irradiance_ = builder.write<VoxelIrradiance>("irradiance", "light that arrives at the voxels' surfaces");
}

void InjectLightRays::plan(PassPlan& plan) {
    paths_.plan(plan, kName, params_, std::min(params_.raysPerLight, kMaxBatchRays), plan.get(voxels_),
                requireLightSources(*plan.frame.scene, kName));
}

void InjectLightRays::prepare(PassSetup& setup) {
    emit_ = makeComputeProgram(setup.device, setup.compiler.compile("passes/inject_light_rays/emit.comp"));
    paths_.prepare(setup);
}

void InjectLightRays::record(PassContext& context) {
    const SurfaceVoxels& voxels = context.get(voxels_);
    const std::vector<LightSource> sources = lightSources(*context.frame.scene);
    const BoundingSphere sphere = boundingSphere(context.frame.scene->geometry);
    paths_.begin(context, voxels, sources);
    for (uint32_t s = 0; s < sources.size(); ++s) {
        const uint32_t seed = randomSeed(context.frame, s);
        for (uint32_t first = 0; first < params_.raysPerLight; first += kMaxBatchRays) {
            const uint32_t count = std::min(kMaxBatchRays, params_.raysPerLight - first);
            context.stream.dispatch(
                emit_, context.scene.bindings({{"rays", paths_.rays()}, {"paths", paths_.paths()}}),
                EmitPush{sources[s].kind, sources[s].light, first, count, params_.raysPerLight, seed,
                         context.scene.emitterCount, sphere.center, sphere.radius},
                linearGroups(count));
            paths_.follow(context, voxels, {seed, first, count});
        }
    }
    paths_.finish(context, voxels, context.get(irradiance_));
}

}  // namespace voxray
