#include "passes/inject_voxel_rays/inject_voxel_rays.h"

#include "passes/common/compute/random_seed.h"

namespace voxray {

void InjectVoxelRays::declare(PassBuilder& builder) {
    voxels_ = builder.read<SurfaceVoxels>("voxels", "surface voxels to light");
    surfels_ = builder.read<Surfels>("surfels", "points where irradiance is measured");
    irradiance_ = builder.write<VoxelIrradiance>("irradiance", "light that arrives at the voxels' surfaces");
}

void InjectVoxelRays::plan(PassPlan& plan) {
    plan.get(irradiance_).lightBounces = params_.bounces;
    sources_ = requireLightSources(*plan.frame.scene, kName);
    injection_.plan(plan, kName, params_, {Surfels::kChunk, true, params_.bounces > 0, params_.lightSamples},
                    plan.get(voxels_));
}

void InjectVoxelRays::prepare(PassSetup& setup) {
    injection_.prepare(setup);
}

void InjectVoxelRays::record(PassContext& context) {
    const uint32_t seed = randomSeed(context.frame, context.frameIndex);
    const PathScene scene{context.get(voxels_), sources_};
    VoxelIrradiance& irradiance = context.get(irradiance_);
    injection_.begin(context, scene, irradiance);
    for (const Surfels::Chunk& chunk : context.get(surfels_).chunks)
        injection_.light(context, scene, chunk.surfels, chunk.count, params_, seed);
    injection_.finish(context, scene.voxels, irradiance);
    requireLight(context.stream, scene.voxels, irradiance, *context.frame.scene);
    injection_.fillUnknown(context, scene.voxels, irradiance);
}

}  // namespace voxray
