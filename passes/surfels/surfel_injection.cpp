#include "passes/surfels/surfel_injection.h"

namespace voxray {

SurfelInjection::SurfelInjection(ProgramOwner& owner)
    : owner_(owner),
      write_(owner, "write_irradiance.comp"),
      fillUnknown_(owner, "passes/common/voxels/fill_unknown.comp") {}

void SurfelInjection::plan(PassPlan& plan, const std::string& pass, const WriteParams& params,
                           const SurfaceVoxels& voxels) {
    VoxelAccumulator::plan(plan, pass, params);
    write_.define(VoxelAccumulator::defines(params.write));
    direct_.emplace(owner_, params);
    indirect_.emplace(owner_, params);
    plan.estimate(voxels.estimatedCount * VoxelIrradiance::bytes(1));
}

void SurfelInjection::begin(PassContext& context, const PathScene& scene, VoxelIrradiance& irradiance) {
    const SurfaceVoxels& voxels = scene.voxels;
    irradiance.allocate(context.device, voxels.voxelCount);
    context.stream.fill(irradiance.area, 0);
    const float typicalIrradiance = meanIrradiance(scene.sources, context.frame.scene->geometry);
    direct_->begin(context.device, context.stream, voxels, typicalIrradiance);
    indirect_->begin(context.device, context.stream, voxels, typicalIrradiance);
}

void SurfelInjection::writeDirect(PassContext& context, const Buffer& surfels, uint32_t count,
                                  const Buffer& irradiance) const {
    write(context, *direct_, surfels, count, irradiance);
}

void SurfelInjection::writeIndirect(PassContext& context, const Buffer& surfels, uint32_t count,
                                    const Buffer& irradiance) const {
    write(context, *indirect_, surfels, count, irradiance);
}

void SurfelInjection::write(PassContext& context, const VoxelAccumulator& accumulator, const Buffer& surfels,
                            uint32_t count, const Buffer& irradiance) const {
    context.dispatch(write_, count,
                     {accumulator,
                      {"surfels", surfels},
                      {"irradiance", irradiance},
                      {"count", count},
                      {"scale", accumulator.scale()}});
}

void SurfelInjection::finish(PassContext& context, const SurfaceVoxels& voxels, const VoxelIrradiance& irradiance) {
    direct_->resolve(context.stream, voxels, irradiance.direct, irradiance.area);
    indirect_->resolve(context.stream, voxels, irradiance.indirect, irradiance.area);
    context.stream.finish();
    direct_->end();
    indirect_->end();
}

void SurfelInjection::fillUnknown(PassContext& context, const SurfaceVoxels& voxels,
                                  const VoxelIrradiance& irradiance) const {
    const uint64_t bytes = irradiance.area.bytes();
    Buffer measured(context.device, "areas measured", bytes);
    context.stream.copy(irradiance.area, measured, bytes);
    const uint32_t words = uint32_t(voxels.words());
    context.dispatch(fillUnknown_, words,
                     {voxels,
                      {"measured", measured},
                      {"area", irradiance.area},
                      {"DirectRef", irradiance.direct.ref()},
                      {"IndirectRef", irradiance.indirect.ref()},
                      {"words", words}});
    context.stream.finish();
}

}  // namespace voxray
