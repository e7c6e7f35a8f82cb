#include "passes/inject_voxel_rays/inject_voxel_rays.h"

#include "passes/common/compute/dispatch.h"
#include "passes/common/compute/random_seed.h"
#include "passes/common/view/frame_image.h"

namespace voxray {
namespace {

struct MarkPush {
    gpu::VoxelGrid grid;
    gpu::GatherLayout layout;
    uint32_t firstBlock;
    uint32_t rays;
};

}  // namespace

void InjectVoxelRays::declare(PassBuilder& builder) {
    voxels_ = builder.read<SurfaceVoxels>("voxels", "surface voxels to light");
    surfels_ = builder.read<Surfels>("surfels", "points where irradiance is measured");
    if (params_.demand) {
        gbuffer_ = builder.read<GBuffer>("gbuffer", "where the gather rays start");
        hits_ = builder.read<GatherHits>("gather_hits", "where the gather rays hit");
    }
    irradiance_ = builder.write<VoxelIrradiance>("irradiance", "light that arrives at the voxels' surfaces");
}

void InjectVoxelRays::plan(PassPlan& plan) {
    sources_ = requireLightSources(*plan.frame.scene, kName);
    plan.get(irradiance_).eachFrame = params_.demand;
    const SurfaceVoxels& voxels = plan.get(voxels_);
    if (params_.demand) {
        plan.reserve("voxel samples (estimated)", 2 * VoxelAccumulator::plan(plan, kName, params_, voxels));
        plan.reserve("irradiance (estimated)", VoxelIrradiance::bytes(voxels.voxelCount));
        plan.reserve("paths", SurfelPaths::bytes(paths()));
        plan.reserve("faces asked for (estimated)", uint64_t(voxels.voxelCount) * sizeof(uint32_t));
    } else {
        SurfelFeedback::plan(plan, kName, params_, voxels);
        plan.reserve("shadow rays of a chunk of surfels",
                     SurfelLight::bytes(Surfels::kChunk) + Surfels::kChunk * 4 * sizeof(float));
    }
}

void InjectVoxelRays::prepare(PassSetup& setup) {
    if (params_.demand) {
        const auto program = [&](const char* file) {
            return makeComputeProgram(setup.device, setup.compiler.compile(file));
        };
        direct_ = VoxelAccumulator(setup.device, setup.compiler, params_);
        indirect_ = VoxelAccumulator(setup.device, setup.compiler, params_);
        surfelPaths_ = SurfelPaths(setup, paths());
        mark_ = program("passes/inject_voxel_rays/mark.comp");
        select_ = program("passes/inject_voxel_rays/select.comp");
        count_ = Buffer(setup.device, "number of surfels asked for", sizeof(uint32_t));
        sampler_ = texelSampler(setup.device);
    } else {
        light_.emplace(setup, Surfels::kChunk);
        feedback_ = SurfelFeedback(setup, params_);
        surfelDirect_ =
            Buffer(setup.device, "surfels' direct irradiance", Surfels::kChunk * 4 * sizeof(float));
    }
}

void InjectVoxelRays::record(PassContext& context) {
    const uint32_t seed = randomSeed(context.frame, context.frameIndex);
    if (params_.demand)
        lightAsked(context, seed);
    else
        lightAll(context, seed);
    context.stream.finish();
}

void InjectVoxelRays::lightAsked(PassContext& context, uint32_t seed) {
    const SurfaceVoxels& voxels = context.get(voxels_);
    const GatherHits& hits = context.get(hits_);
    VoxelIrradiance& irradiance = context.get(irradiance_);
    CommandStream& stream = context.stream;
    irradiance.allocate(context.device, voxels.voxelCount);
    stream.fill(irradiance.area, 0);
    const float typical = meanIrradiance(sources_, context.frame.scene->geometry);
    direct_.begin(context.device, stream, voxels, typical);
    indirect_.begin(context.device, stream, voxels, typical);

    // Mark the faces that the gather rays will read.
    const uint64_t askedBytes = uint64_t(voxels.voxelCount) * sizeof(uint32_t);
    if (!asked_ || asked_.bytes() != askedBytes)
        asked_ = Buffer(context.device, "faces asked for", askedBytes);
    stream.fill(asked_, 0);
    for (uint32_t b = 0; b < hits.batches.size(); ++b) {
        const uint32_t rays = hits.batchBlocks(b) * hits.layout.raysPerBlock;
        stream.dispatch(mark_,
                        context.scene.bindings({{"voxelOccupancy", voxels.occupancy},
                                                {"voxelRank", voxels.rank},
                                                {"VoxelMaterialsAt", voxels.materials.at()},
                                                {"hits", hits.batches[b]},
                                                {"position", context.get(gbuffer_).position, sampler_},
                                                {"asked", asked_}}),
                        MarkPush{voxels.grid, hits.layout, b * hits.blocksPerBatch, rays},
                        linearGroups(rays));
    }

    // Light their surfels by paths.
    for (const Surfels::Chunk& chunk : context.get(surfels_).chunks) {
        stream.fill(count_, 0);
        stream.dispatch(select_,
                        {{"surfels", chunk.surfels},
                         {"asked", asked_},
                         {"selected", surfelPaths_.first()},
                         {"count", count_}},
                        chunk.count, linearGroups(chunk.count));
        const uint32_t count = stream.readAs<uint32_t>(count_, 1)[0];
        for (uint32_t ray = 0; ray < params_.rays && count > 0; ++ray)
            surfelPaths_.run(context, sources_, count, seed + ray * 0xc2b2ae35u,
                             {voxels, direct_, indirect_});
    }
    direct_.resolve(stream, voxels, irradiance.direct, irradiance.area);
    indirect_.resolve(stream, voxels, irradiance.indirect, irradiance.area);
    stream.finish();
}

void InjectVoxelRays::lightAll(PassContext& context, uint32_t seed) {
    const SurfaceVoxels& voxels = context.get(voxels_);
    const Surfels& surfels = context.get(surfels_);
    VoxelIrradiance& irradiance = context.get(irradiance_);
    feedback_.begin(context, voxels, sources_, irradiance);
    for (const Surfels::Chunk& chunk : surfels.chunks) {
        light_->measure(context, sources_, chunk.surfels, chunk.count, params_.lightSamples, seed,
                        surfelDirect_);
        feedback_.addDirect(context, chunk, surfelDirect_);
    }
    feedback_.finish(context, voxels, surfels, seed, irradiance);
}

}  // namespace voxray
