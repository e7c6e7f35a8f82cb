#include "passes/common/surfels/surfel_feedback.h"

#include "passes/common/compute/dispatch.h"

namespace voxray {
namespace {

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

void SurfelFeedback::prepare(PassSetup& setup) {
    direct_ = VoxelAccumulator(setup.device, setup.compiler, params_);
    indirect_ = VoxelAccumulator(setup.device, setup.compiler, params_);
    faces_ = FaceIrradiance(setup.device, setup.compiler);
    const auto program = [&](const char* file, const Defines& defines = {}) {
        return makeComputeProgram(setup.device, setup.compiler.compile(file, defines));
    };
    write_ = program("passes/common/surfels/surfel_write.comp", VoxelAccumulator::defines(params_.write));
    gather_ = program("passes/common/surfels/surfel_gather.comp");
    feedback_ =
        program("passes/common/surfels/surfel_feedback.comp", VoxelAccumulator::defines(params_.write));
}

void SurfelFeedback::plan(PassPlan& plan, const std::string& pass, const FeedbackParams& params,
                          const SurfaceVoxels& voxels) {
    params_ = params;
    // Samples of direct light are free again before those of the bounces begin.
    plan.reserveScratch("voxel samples (estimated)", VoxelAccumulator::plan(plan, pass, params, voxels));
    if (params.bounces > 0)
        plan.reserveScratch("face irradiance (estimated)", FaceIrradiance::bytes(voxels.voxelCount));
    plan.reserve("irradiance (estimated)", VoxelIrradiance::bytes(voxels.voxelCount));
    plan.buffer(rays_, "gather rays", Surfels::kChunk * sizeof(Ray));
    plan.buffer(hits_, "gather ray hits", Surfels::kChunk * sizeof(Hit));
}

void SurfelFeedback::begin(PassContext& context, const SurfaceVoxels& voxels,
                           const std::vector<LightSource>& sources, VoxelIrradiance& irradiance) {
    irradiance.allocate(context.device, voxels.voxelCount);
    context.stream.fill(irradiance.area, 0);
    context.stream.fill(irradiance.indirect, 0);
    typicalIrradiance_ = meanIrradiance(sources, context.frame.scene->geometry);
    direct_.begin(context.device, context.stream, voxels, typicalIrradiance_);
}

void SurfelFeedback::addDirect(PassContext& context, const Surfels::Chunk& chunk,
                               const Buffer& direct) const {
    std::vector<Binding> bindings = direct_.bindings();
    bindings.insert(bindings.end(), {{"surfels", chunk.surfels}, {"irradiance", direct}});
    context.stream.dispatch(write_, bindings, WritePush{chunk.count, direct_.scale()},
                            linearGroups(chunk.count));
}

void SurfelFeedback::finish(PassContext& context, const SurfaceVoxels& voxels, const Surfels& surfels,
                            uint32_t seed, const VoxelIrradiance& irradiance) {
    CommandStream& stream = context.stream;
    direct_.resolve(stream, voxels, irradiance.direct, irradiance.area);
    requireLight(stream, voxels, irradiance);
    direct_.end();

    // One more bounce an iteration, from the light that the last one left.
    for (uint32_t bounce = 0; bounce < params_.bounces; ++bounce) {
        faces_.update(stream, voxels, irradiance);
        indirect_.begin(context.device, stream, voxels, typicalIrradiance_);
        for (const Surfels::Chunk& chunk : surfels.chunks) {
            for (uint32_t ray = 0; ray < params_.raysPerPoint; ++ray) {
                stream.dispatch(
                    gather_, {{"surfels", chunk.surfels}, {"rays", rays_}},
                    GatherPush{chunk.count, ray, params_.raysPerPoint, seed + 0x51u + bounce * 0x9e3779b9u},
                    linearGroups(chunk.count));
                context.tracer.closestHit(stream, rays_, hits_, chunk.count);
                std::vector<Binding> bindings = context.scene.bindings({{"voxelOccupancy", voxels.occupancy},
                                                                        {"voxelRank", voxels.rank},
                                                                        {"faceIrradiance", faces_.buffer()},
                                                                        {"surfels", chunk.surfels},
                                                                        {"hits", hits_}});
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
    indirect_.end();
    faces_.end();
}

}  // namespace voxray
