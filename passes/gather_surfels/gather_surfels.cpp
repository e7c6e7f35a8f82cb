#include "passes/gather_surfels/gather_surfels.h"

#include "passes/common/compute/dispatch.h"

namespace voxray {
namespace {

struct GatherPush {
    gpu::VoxelGrid grid;
    uint32_t samples;
    float noise;
};

}  // namespace

void GatherSurfels::declare(PassBuilder& builder) {
    gbuffer_ = builder.read<GBuffer>("gbuffer", "what the camera sees");
    voxels_ = builder.read<SurfaceVoxels>("voxels", "surface voxels, by which surfels are found");
    irradiance_ = builder.read<VoxelIrradiance>("irradiance", "light of voxels, where no surfel is near");
    surfels_ = builder.read<SurfelsByVoxel>("surfels_by_voxel", "the surfels of each voxel");
    light_ = builder.read<SurfelIrradiance>("surfel_irradiance", "light that arrives at surfels");
    indirect_ = builder.write<FrameImage>("indirect", "radiance reflected of indirect light");
}

void GatherSurfels::plan(PassPlan& plan) {
    plan.get(indirect_).lightBounces = plan.get(irradiance_).lightBounces;
    plan.image(plan.get(indirect_).image, "indirect", frameImageDesc(plan.frame));
}

void GatherSurfels::prepare(PassSetup& setup) {
    gather_ = makeComputeProgram(setup.device, setup.compiler.compile("passes/gather_surfels/gather.comp"));
    sampler_ = texelSampler(setup.device);
}

void GatherSurfels::record(PassContext& context) {
    const GBuffer& gbuffer = context.get(gbuffer_);
    const SurfaceVoxels& voxels = context.get(voxels_);
    const VoxelIrradiance& irradiance = context.get(irradiance_);
    const SurfelsByVoxel& surfels = context.get(surfels_);
    context.stream.dispatch(gather_,
                            voxels.bindings({{"position", gbuffer.position, sampler_},
                                             {"normal", gbuffer.normal, sampler_},
                                             {"geometricNormal", gbuffer.geometricNormal, sampler_},
                                             {"albedo", gbuffer.albedo, sampler_},
                                             {"VoxelFluxAt", irradiance.indirect.at()},
                                             {"voxelArea", irradiance.area},
                                             {"begins", surfels.begins},
                                             {"ends", surfels.ends},
                                             {"SortedAt", surfels.sorted.at()},
                                             {"LightAt", context.get(light_).indirect.at()},
                                             {"result", context.get(indirect_).image}}),
                            GatherPush{voxels.grid, gbuffer.samples, context.get(light_).relativeVariance},
                            pixelGroups(context.frame.width, context.frame.height));
}

}  // namespace voxray
