#include "passes/gather_surfels/gather_surfels.h"

#include "passes/common/compute/dispatch.h"

namespace voxray {
namespace {

/// Surfaces in a pixel, at most.
constexpr uint32_t kGroups = 4;

struct GatherPush {
    gpu::VoxelGrid grid;
    glm::ivec2 extent;
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
    probed_ = plan.get(surfels_).coveredSides;
    if (probed_) {
        const uint64_t groups = uint64_t(plan.frame.width) * plan.frame.height * kGroups;
        plan.scratchBuffer(probes_, "rays that tell covered surfaces", groups * sizeof(Ray));
        plan.scratchBuffer(covered_, "covered surfaces", groups * sizeof(uint32_t));
    }
    plan.image(plan.get(indirect_).image, "indirect", frameImageDesc(plan.frame));
}

void GatherSurfels::prepare(PassSetup& setup) {
    const auto program = [&](const char* file) {
        return makeComputeProgram(
            setup.device, setup.compiler.compile(
                              file, {{"GROUPS", std::to_string(kGroups)}, {"PROBED", probed_ ? "1" : "0"}}));
    };
    if (probed_) probe_ = program("passes/gather_surfels/probe.comp");
    gather_ = program("passes/gather_surfels/gather.comp");
    sampler_ = texelSampler(setup.device);
}

void GatherSurfels::record(PassContext& context) {
    const GBuffer& gbuffer = context.get(gbuffer_);
    const SurfaceVoxels& voxels = context.get(voxels_);
    const VoxelIrradiance& irradiance = context.get(irradiance_);
    const SurfelsByVoxel& surfels = context.get(surfels_);
    const glm::uvec2 extent(context.frame.width, context.frame.height);
    const GatherPush push{voxels.grid, extent, gbuffer.samples, context.get(light_).relativeVariance};
    std::vector<Binding> bindings = voxels.bindings({{"position", gbuffer.position, sampler_},
                                                     {"normal", gbuffer.normal, sampler_},
                                                     {"geometricNormal", gbuffer.geometricNormal, sampler_},
                                                     {"begins", surfels.begins},
                                                     {"ends", surfels.ends},
                                                     {"SortedAt", surfels.sorted.at()}});
    const auto with = [&](std::vector<Binding> more) {
        more.insert(more.end(), bindings.begin(), bindings.end());
        return more;
    };

    // Which surfaces lie in gaps narrower than a voxel.
    if (probed_) {
        context.stream.dispatch(probe_, with({{"probes", probes_}}), push, pixelGroups(extent.x, extent.y));
        context.tracer.occluded(context.stream, probes_, covered_, extent.x * extent.y * kGroups);
        bindings.push_back({"covered", covered_});
    }

    context.stream.dispatch(gather_,
                            with({{"albedo", gbuffer.albedo, sampler_},
                                  {"VoxelFluxAt", irradiance.indirect.at()},
                                  {"voxelArea", irradiance.area},
                                  {"LightAt", context.get(light_).indirect.at()},
                                  {"result", context.get(indirect_).image}}),
                            push, pixelGroups(extent.x, extent.y));
}

}  // namespace voxray
