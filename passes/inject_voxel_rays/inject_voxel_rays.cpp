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
    feedback_.plan(plan, kName, params_, plan.get(voxels_));
    light_.plan(plan, Surfels::kChunk);
    plan.buffer(surfelDirect_, "surfels' direct irradiance", Surfels::kChunk * 4 * sizeof(float));
}

void InjectVoxelRays::prepare(PassSetup& setup) {
    light_.prepare(setup);
    feedback_.prepare(setup);
}

void InjectVoxelRays::record(PassContext& context) {
    const uint32_t seed = randomSeed(context.frame, context.frameIndex);
    const SurfaceVoxels& voxels = context.get(voxels_);
    const Surfels& surfels = context.get(surfels_);
    VoxelIrradiance& irradiance = context.get(irradiance_);
    feedback_.begin(context, voxels, sources_, irradiance);
    for (const Surfels::Chunk& chunk : surfels.chunks) {
        light_.measure(context, sources_, chunk.surfels, chunk.count, params_.lightSamples, seed,
                       surfelDirect_);
        feedback_.addDirect(context, chunk, surfelDirect_);
    }
    feedback_.finish(context, voxels, surfels, seed, irradiance);
    context.stream.finish();
}

}  // namespace voxray
