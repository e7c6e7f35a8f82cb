#include "passes/inject_voxel_rays/inject_voxel_rays.h"

#include "passes/common/dispatch.h"
#include "passes/common/frame_image.h"

namespace voxray {
namespace {

struct MarkPush {
    gpu::VoxelGrid grid;
    gpu::GatherLayout layout;
    uint32_t firstBlock;
    uint32_t rays;
};

struct WritePush {
    uint32_t count;
    float scale;
};

struct GatherPush {
    uint32_t count;
    uint32_t ray;
    uint32_t rays;
    uint32_t seed;
};

struct FeedbackPush {
    gpu::VoxelGrid grid;
    uint32_t count;
    float scale;
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
    const SurfaceVoxels& voxels = plan.get(voxels_);
    VoxelWrites::plan(plan, kName, params_, voxels);
    VoxelWrites::plan(plan, kName, params_, voxels);
    plan.reserve("irradiance (estimated)", VoxelIrradiance::bytes(voxels.voxelCount));
    if (params_.demand) {
        plan.reserve("paths", SurfelPaths::bytes(paths()));
        plan.reserve("faces asked for (estimated)", uint64_t(voxels.voxelCount) * sizeof(uint32_t));
    } else {
        plan.reserve("face irradiance (estimated)", FaceIrradiance::bytes(voxels.voxelCount));
        plan.reserve("rays of a chunk of surfels", SurfelLight::bytes(Surfels::kChunk) +
                                                       Surfels::kChunk * (sizeof(Ray) + sizeof(Hit) + 16));
    }
}

void InjectVoxelRays::prepare(PassSetup& setup) {
    const auto program = [&](const char* file, const Defines& defines = {}) {
        return makeComputeProgram(setup.device, setup.compiler.compile(file, defines));
    };
    const auto buffer = [&](const char* name, uint64_t bytes) { return Buffer(setup.device, name, bytes); };
    direct_ = VoxelWrites(setup.device, setup.compiler, params_);
    indirect_ = VoxelWrites(setup.device, setup.compiler, params_);
    if (params_.demand) {
        surfelPaths_ = SurfelPaths(setup, paths());
        mark_ = program("passes/inject_voxel_rays/mark.comp");
        select_ = program("passes/inject_voxel_rays/select.comp");
        count_ = buffer("number of surfels asked for", sizeof(uint32_t));
        sampler_ = texelSampler(setup.device);
    } else {
        light_.emplace(setup, Surfels::kChunk);
        write_ = program("passes/common/surfel_write.comp", VoxelWrites::defines(params_.write));
        gather_ = program("passes/common/surfel_gather.comp");
        feedback_ = program("passes/inject_voxel_rays/feedback.comp", VoxelWrites::defines(params_.write));
        faces_ = FaceIrradiance(setup.device, setup.compiler);
        surfelDirect_ = buffer("surfels' direct irradiance", Surfels::kChunk * 4 * sizeof(float));
        rays_ = buffer("gather rays", Surfels::kChunk * sizeof(Ray));
        rayHits_ = buffer("gather ray hits", Surfels::kChunk * sizeof(Hit));
    }
}

void InjectVoxelRays::record(PassContext& context) {
    const SurfaceVoxels& voxels = context.get(voxels_);
    VoxelIrradiance& irradiance = context.get(irradiance_);
    irradiance.allocate(context.device, voxels.voxelCount);
    context.stream.fill(irradiance.area, 0);
    const float typical = meanIrradiance(sources_, context.frame.scene->geometry);
    direct_.begin(context.device, context.stream, voxels, typical);
    indirect_.begin(context.device, context.stream, voxels, typical);
    const uint32_t seed = uint32_t(context.frame.seed * 0x9e3779b9u) + context.frameIndex * 0x85ebca6bu;
    if (params_.demand)
        lightAsked(context, seed);
    else
        lightAll(context, seed);
    context.stream.finish();
}

void InjectVoxelRays::lightAsked(PassContext& context, uint32_t seed) {
    const SurfaceVoxels& voxels = context.get(voxels_);
    const GatherHits& hits = context.get(hits_);
    CommandStream& stream = context.stream;

    // Mark the faces that the gather rays will read.
    const Buffer asked(context.device, "faces asked for", uint64_t(voxels.voxelCount) * sizeof(uint32_t));
    stream.fill(asked, 0);
    for (uint32_t b = 0; b < hits.batches.size(); ++b) {
        const uint32_t rays = hits.batchBlocks(b) * hits.layout.raysPerBlock;
        stream.dispatch(mark_,
                        context.scene.bindings({{"voxelOccupancy", voxels.occupancy},
                                                {"voxelRank", voxels.rank},
                                                {"voxelMaterials", voxels.materials},
                                                {"hits", hits.batches[b]},
                                                {"position", context.get(gbuffer_).position, sampler_},
                                                {"asked", asked}}),
                        MarkPush{voxels.grid, hits.layout, b * hits.blocksPerBatch, rays},
                        linearGroups(rays));
    }

    // Light their surfels by paths.
    for (const Surfels::Chunk& chunk : context.get(surfels_).chunks) {
        stream.fill(count_, 0);
        stream.dispatch(select_,
                        {{"surfels", chunk.surfels},
                         {"asked", asked},
                         {"selected", surfelPaths_.first()},
                         {"count", count_}},
                        chunk.count, linearGroups(chunk.count));
        const uint32_t count = stream.readAs<uint32_t>(count_, 1)[0];
        if (count > 0) surfelPaths_.run(context, sources_, count, seed, {voxels, direct_, indirect_});
    }
    const VoxelIrradiance& irradiance = context.get(irradiance_);
    direct_.resolve(stream, voxels, irradiance.direct, irradiance.area);
    indirect_.resolve(stream, voxels, irradiance.indirect, irradiance.area);
    stream.finish();
}

void InjectVoxelRays::lightAll(PassContext& context, uint32_t seed) {
    const SurfaceVoxels& voxels = context.get(voxels_);
    const Surfels& surfels = context.get(surfels_);
    const VoxelIrradiance& irradiance = context.get(irradiance_);
    CommandStream& stream = context.stream;

    // Direct light of every surfel.
    for (const Surfels::Chunk& chunk : surfels.chunks) {
        light_->measure(context, sources_, chunk.surfels, chunk.count, params_.lightSamples, seed,
                        surfelDirect_);
        std::vector<Binding> bindings = direct_.bindings();
        bindings.insert(bindings.end(), {{"surfels", chunk.surfels}, {"irradiance", surfelDirect_}});
        stream.dispatch(write_, bindings, WritePush{chunk.count, direct_.scale()}, linearGroups(chunk.count));
    }
    direct_.resolve(stream, voxels, irradiance.direct, irradiance.area);
    stream.fill(irradiance.indirect, 0);
    requireLight(stream, voxels, irradiance);

    // One more bounce an iteration, from the light that the last one left.
    for (uint32_t bounce = 0; bounce < params_.bounces; ++bounce) {
        faces_.update(stream, voxels, irradiance);
        if (bounce > 0)
            indirect_.begin(context.device, stream, voxels,
                            meanIrradiance(sources_, context.frame.scene->geometry));
        for (const Surfels::Chunk& chunk : surfels.chunks) {
            for (uint32_t ray = 0; ray < params_.rays; ++ray) {
                stream.dispatch(
                    gather_, {{"surfels", chunk.surfels}, {"rays", rays_}},
                    GatherPush{chunk.count, ray, params_.rays, seed + 0x51u + bounce * 0x9e3779b9u},
                    linearGroups(chunk.count));
                context.tracer.closestHit(stream, rays_, rayHits_, chunk.count);
                std::vector<Binding> bindings = context.scene.bindings({{"voxelOccupancy", voxels.occupancy},
                                                                        {"voxelRank", voxels.rank},
                                                                        {"faceIrradiance", faces_.buffer()},
                                                                        {"surfels", chunk.surfels},
                                                                        {"hits", rayHits_}});
                const std::vector<Binding> writes = indirect_.bindings();
                bindings.insert(bindings.end(), writes.begin(), writes.end());
                stream.dispatch(feedback_, bindings,
                                FeedbackPush{voxels.grid, chunk.count, indirect_.scale()},
                                linearGroups(chunk.count));
            }
        }
        indirect_.resolve(stream, voxels, irradiance.indirect, irradiance.area);
        stream.finish();
    }
}

}  // namespace voxray
