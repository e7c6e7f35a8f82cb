#include "passes/gather_surfels/gather_surfels.h"

#include <algorithm>

#include "passes/common/compute/dispatch.h"
#include "passes/gather_surfels/undecided.h"

namespace voxray {
namespace {

/// Surfaces in pixels whose kind is told at a time, unless a row has more: scratch memory does not grow with
/// the image.
constexpr uint32_t kBandSurfaces = 1u << 19;

struct GatherPush {
    gpu::VoxelGrid grid;
    glm::ivec2 extent;
    uint32_t firstRow;
    float noise;
};

struct ResolveProbesPush {
    glm::ivec2 extent;
    uint32_t firstRow;
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
    samples_ = plan.get(gbuffer_).samples;
    const uint32_t perPixel = samples_ * samples_, width = plan.frame.width;
    bandRows_ = plan.frame.height;
    if (probed_) {
        bandRows_ = std::clamp(kBandSurfaces / (width * perPixel), 1u, plan.frame.height);
        const uint64_t surfaces = uint64_t(width) * bandRows_ * perPixel;
        plan.scratchBuffer(count_, "number of undecided surfaces", sizeof(uint32_t));
        plan.scratchBuffer(first_, "undecided surfaces of pixels", width * bandRows_ * sizeof(uint32_t));
        plan.scratchBuffer(undecided_, "undecided surfaces", surfaces * sizeof(gpu::Undecided));
        plan.scratchBuffer(probes_, "rays that tell covered surfaces", surfaces * sizeof(Ray));
        plan.scratchBuffer(covered_, "covered surfaces", surfaces * sizeof(uint32_t));
    }
    plan.image(plan.get(indirect_).image, "indirect", frameImageDesc(plan.frame));
}

void GatherSurfels::prepare(PassSetup& setup) {
    const auto program = [&](const char* file) {
        return makeComputeProgram(setup.device,
                                  setup.compiler.compile(file, {{"SAMPLES", std::to_string(samples_)},
                                                                {"PROBED", probed_ ? "1" : "0"}}));
    };
    gather_ = program("passes/gather_surfels/gather.comp");
    if (probed_) resolve_ = program("passes/gather_surfels/resolve.comp");
    sampler_ = texelSampler(setup.device);
}

void GatherSurfels::record(PassContext& context) {
    const GBuffer& gbuffer = context.get(gbuffer_);
    const SurfaceVoxels& voxels = context.get(voxels_);
    const VoxelIrradiance& irradiance = context.get(irradiance_);
    const SurfelsByVoxel& surfels = context.get(surfels_);
    const Image& result = context.get(indirect_).image;
    std::vector<Binding> gather =
        voxels.bindings(context.scene.bindings({{"position", gbuffer.position, sampler_},
                                                {"normal", gbuffer.normal, sampler_},
                                                {"geometricNormal", gbuffer.geometricNormal, sampler_},
                                                {"albedo", gbuffer.albedo, sampler_},
                                                {"lists", surfels.lists},
                                                {"VoxelFluxAt", irradiance.indirect.at()},
                                                {"voxelArea", irradiance.area},
                                                {"LitAt", context.get(light_).lit.at()},
                                                {"result", result}}));
    if (probed_)
        gather.insert(gather.end(),
                      {{"count", count_}, {"surfaces", undecided_}, {"probes", probes_}, {"first", first_}});

    const uint32_t width = context.frame.width;
    for (uint32_t row = 0; row < context.frame.height; row += bandRows_) {
        const uint32_t rows = std::min(bandRows_, context.frame.height - row);
        const GatherPush push{voxels.grid, glm::uvec2(width, rows), row,
                              context.get(light_).relativeVariance};
        if (probed_) context.stream.fill(count_, 0);
        context.stream.dispatch(gather_, gather, push, pixelGroups(width, rows));
        if (!probed_) continue;

        // Which of the surfaces that surfels of both kinds are near lie in gaps narrower than a voxel.
        const uint32_t undecided = context.stream.readAs<uint32_t>(count_, 1)[0];
        if (undecided == 0) continue;
        context.tracer.occluded(context.stream, probes_, covered_, undecided, Coherence::Coherent);
        context.stream.dispatch(
            resolve_,
            {{"surfaces", undecided_}, {"covered", covered_}, {"first", first_}, {"result", result}},
            ResolveProbesPush{push.extent, row}, pixelGroups(width, rows));
    }
}

}  // namespace voxray
