#include "passes/inject_voxel_rays/inject_voxel_rays.h"

#include "passes/common/compute/random_seed.h"

namespace voxray {

void InjectVoxelRays::declare(PassBuilder& builder) {
    voxels_ = builder.read<SurfaceVoxels>("voxels", "surface voxels to light");
    surfels_ = builder.read<Surfels>("surfels", "points where irradiance is measured");
    irradiance_ = builder.write<VoxelIrradiance>("irradiance", "light that arrives at the voxels' surfaces");
}

void InjectVoxelRays::plan(PassPlan& plan) {
    sources_ = requireLightSources(*plan.frame.scene, kName);
    feedback_.plan(plan, kName, params_, DirectLight::ByShadowRays, params_.lightSamples, plan.get(voxels_));
}

void InjectVoxelRays::prepare(PassSetup& setup) {
    feedback_.prepare(setup);
}

void InjectVoxelRays::record(PassContext& context) {
    const uint32_t seed = randomSeed(context.frame, context.frameIndex);
    const SurfaceVoxels& voxels = context.get(voxels_);
    const Surfels& surfels = context.get(surfels_);
    VoxelIrradiance& irradiance = context.get(irradiance_);
    feedback_.begin(context, voxels, sources_, irradiance);
    for (const Surfels::Chunk& chunk : surfels.chunks)
        feedback_.measureDirect(context, chunk, sources_, seed);
    feedback_.finish(context, voxels, surfels, sources_, seed, irradiance);
    context.stream.finish();
}

}  // namespace voxray
