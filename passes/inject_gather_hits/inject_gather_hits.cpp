#include "passes/inject_gather_hits/inject_gather_hits.h"

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

uint64_t faceBytes(const SurfaceVoxels& voxels) {
    return uint64_t(voxels.voxelCount) * sizeof(uint32_t);
}

}  // namespace

void InjectGatherHits::declare(PassBuilder& builder) {
    voxels_ = builder.read<SurfaceVoxels>("voxels", "surface voxels to light");
    surfels_ = builder.read<Surfels>("surfels", "points where irradiance is measured");
    gbuffer_ = builder.read<GBuffer>("gbuffer", "where the gather rays start");
    hits_ = builder.read<GatherHits>("gather_hits", "where the gather rays hit");
    irradiance_ = builder.write<VoxelIrradiance>("irradiance", "light that arrives at the voxels' surfaces");
}

void InjectGatherHits::plan(PassPlan& plan) {
    plan.get(irradiance_).lightBounces = params_.bounces;
    sources_ = requireLightSources(*plan.frame.scene, kName);
    const SurfaceVoxels& voxels = plan.get(voxels_);
    injection_.plan(plan, kName, params_, {Surfels::kChunk, true, params_.bounces > 0, params_.lightSamples},
                    voxels);
    plan.reserve("faces to light (estimated)", faceBytes(voxels));
    plan.reserve("faces with surfels (estimated)", faceBytes(voxels));
    plan.buffer(count_, "number of surfels to light", sizeof(uint32_t));
    plan.buffer(selected_, "surfels to light", Surfels::kChunk * sizeof(gpu::Surfel));
}

void InjectGatherHits::prepare(PassSetup& setup) {
    const auto program = [&](const char* file) {
        return makeComputeProgram(setup.device, setup.compiler.compile(file));
    };
    measuredVersion_.reset();
    measure_ = program("passes/inject_gather_hits/measured_faces.comp");
    mark_ = program("passes/inject_gather_hits/mark.comp");
    select_ = program("passes/inject_gather_hits/select.comp");
    injection_.prepare(setup);
    sampler_ = texelSampler(setup.device);
}

void InjectGatherHits::record(PassContext& context) {
    const PathScene scene{context.get(voxels_), sources_};
    injection_.begin(context, scene, context.get(irradiance_));
    markFaces(context);
    lightFaces(context, scene);
    injection_.finish(context, scene.voxels, context.get(irradiance_));
}

void InjectGatherHits::markFaces(PassContext& context) {
    const SurfaceVoxels& voxels = context.get(voxels_);
    const GatherHits& hits = context.get(hits_);
    const auto clear = [&](Buffer& buffer, const char* name) {
        if (!buffer || buffer.bytes() != faceBytes(voxels)) {
            buffer = {};
            buffer = Buffer(context.device, name, faceBytes(voxels));
        }
        context.stream.fill(buffer, 0);
    };
    clear(faces_, "faces to light");
    if (measuredVersion_ != voxels.version) {
        clear(measured_, "faces with surfels");
        for (const Surfels::Chunk& chunk : context.get(surfels_).chunks)
            context.stream.dispatch(measure_, {{"surfels", chunk.surfels}, {"measured", measured_}},
                                    chunk.count, linearGroups(chunk.count));
        measuredVersion_ = voxels.version;
    }
    for (uint32_t b = 0; b < hits.batches.size(); ++b) {
        const uint32_t rays = hits.batchBlocks(b) * hits.layout.raysPerBlock;
        context.stream.dispatch(
            mark_,
            voxels.bindings(context.scene.bindings({{"hits", hits.batches[b]},
                                                    {"position", context.get(gbuffer_).position, sampler_},
                                                    {"asked", faces_},
                                                    {"measured", measured_}})),
            MarkPush{voxels.grid, hits.layout, b * hits.blocksPerBatch, rays}, linearGroups(rays));
    }
}

void InjectGatherHits::lightFaces(PassContext& context, const PathScene& scene) {
    const uint32_t seed = randomSeed(context.frame, context.frameIndex);
    CommandStream& stream = context.stream;
    for (const Surfels::Chunk& chunk : context.get(surfels_).chunks) {
        stream.fill(count_, 0);
        stream.dispatch(
            select_,
            {{"surfels", chunk.surfels}, {"asked", faces_}, {"selected", selected_}, {"count", count_}},
            chunk.count, linearGroups(chunk.count));
        const uint32_t count = stream.readAs<uint32_t>(count_, 1)[0];
        if (count > 0) injection_.light(context, scene, selected_, count, params_, seed);
    }
}

}  // namespace voxray
