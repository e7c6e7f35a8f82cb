#include "passes/common/surfels/surfel_injection.h"

#include "passes/common/compute/dispatch.h"

namespace voxray {
namespace {

struct WritePush {
    uint32_t count;
    float scale;
};

struct FillPush {
    gpu::VoxelGrid grid;
    uint32_t words;
};

}  // namespace

void SurfelInjection::plan(PassPlan& plan, const std::string& pass, const WriteParams& params,
                           const Rays& rays, const SurfaceVoxels& voxels) {
    params_ = params;
    rays_ = rays;
    const uint64_t irradianceBytes = uint64_t(rays.batch) * 4 * sizeof(float);
    plan.reserveScratch("voxel samples (estimated)", 2 * VoxelAccumulator::plan(plan, pass, params, voxels));
    plan.reserve("irradiance (estimated)", VoxelIrradiance::bytes(voxels.voxelCount));
    if (rays.shadow) plan.buffer(direct_, "surfels' direct irradiance", irradianceBytes);
    if (rays.paths) plan.buffer(indirect_, "surfels' indirect irradiance", irradianceBytes);
    if (rays.shadow || rays.paths) paths_.plan(plan, rays.batch, rays.lightSamples, rays.paths);
}

void SurfelInjection::prepare(PassSetup& setup) {
    directSums_ = VoxelAccumulator(setup.device, setup.compiler, params_);
    indirectSums_ = VoxelAccumulator(setup.device, setup.compiler, params_);
    if (rays_.shadow || rays_.paths) paths_.prepare(setup);
    const auto program = [&](const char* file, const Defines& defines = {}) {
        return makeComputeProgram(setup.device, setup.compiler.compile(file, defines));
    };
    write_ = program("passes/common/surfels/surfel_write.comp", VoxelAccumulator::defines(params_.write));
    fillUnknown_ = program("passes/common/voxels/fill_unknown.comp");
}

void SurfelInjection::begin(PassContext& context, const PathScene& scene, VoxelIrradiance& irradiance) {
    const SurfaceVoxels& voxels = scene.voxels;
    irradiance.allocate(context.device, voxels.voxelCount);
    context.stream.fill(irradiance.area, 0);
    const float typicalIrradiance = meanIrradiance(scene.sources, context.frame.scene->geometry);
    directSums_.begin(context.device, context.stream, voxels, typicalIrradiance);
    indirectSums_.begin(context.device, context.stream, voxels, typicalIrradiance);
}

void SurfelInjection::light(PassContext& context, const PathScene& scene, const Buffer& surfels,
                            uint32_t count, const SurfelParams& params, uint32_t seed) {
    paths_.measure(context, scene, surfels, count, seed, direct_);
    lightIndirect(context, scene, surfels, count, params, seed, direct_);
}

void SurfelInjection::lightIndirect(PassContext& context, const PathScene& scene, const Buffer& surfels,
                                    uint32_t count, const SurfelParams& params, uint32_t seed,
                                    const Buffer& direct) {
    write(context, directSums_, surfels, count, direct);
    for (uint32_t path = 0; path < params.pathsPerPoint && params.bounces > 0; ++path) {
        paths_.begin(context, surfels, count, seed + (path + 1) * 0xc2b2ae35u, indirect_);
        for (uint32_t bounce = 0; bounce < params.bounces; ++bounce) paths_.extend(context, scene, indirect_);
        write(context, indirectSums_, surfels, count, indirect_);
    }
}

void SurfelInjection::write(PassContext& context, const Buffer& surfels, uint32_t count, const Buffer& direct,
                            const Buffer& indirect) const {
    write(context, directSums_, surfels, count, direct);
    write(context, indirectSums_, surfels, count, indirect);
}

void SurfelInjection::write(PassContext& context, const VoxelAccumulator& sums, const Buffer& surfels,
                            uint32_t count, const Buffer& irradiance) const {
    std::vector<Binding> bindings = sums.bindings();
    bindings.insert(bindings.end(), {{"surfels", surfels}, {"irradiance", irradiance}});
    context.stream.dispatch(write_, bindings, WritePush{count, sums.scale()}, linearGroups(count));
}

void SurfelInjection::finish(PassContext& context, const SurfaceVoxels& voxels,
                             const VoxelIrradiance& irradiance) {
    directSums_.resolve(context.stream, voxels, irradiance.direct, irradiance.area);
    indirectSums_.resolve(context.stream, voxels, irradiance.indirect, irradiance.area);
    context.stream.finish();
    directSums_.end();
    indirectSums_.end();
}

void SurfelInjection::fillUnknown(PassContext& context, const SurfaceVoxels& voxels,
                                  const VoxelIrradiance& irradiance) const {
    const uint64_t bytes = irradiance.area.bytes();
    Buffer measured(context.device, "areas measured", bytes);
    context.stream.copy(irradiance.area, measured, bytes);
    const uint32_t words = uint32_t(voxels.words());
    context.stream.dispatch(fillUnknown_,
                            voxels.bindings({{"measured", measured},
                                             {"area", irradiance.area},
                                             {"DirectAt", irradiance.direct.at()},
                                             {"IndirectAt", irradiance.indirect.at()}}),
                            FillPush{voxels.grid, words}, linearGroups(words));
    context.stream.finish();
}

}  // namespace voxray
