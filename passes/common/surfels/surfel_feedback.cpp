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

struct FillPush {
    gpu::VoxelGrid grid;
    uint32_t words;
};

struct HitPush {
    uint32_t count;
    uint32_t ray;
    uint32_t rays;
};

struct FeedbackPush {
    gpu::VoxelGrid grid;
    uint32_t count;
    float scale;
};

uint64_t bounceBytes(const SurfaceVoxels& voxels) {
    return uint64_t(voxels.voxelCount) * kFluxWords * sizeof(uint32_t);
}

uint64_t areaBytes(const SurfaceVoxels& voxels) {
    return uint64_t(voxels.voxelCount) * kAreaWords * sizeof(uint32_t);
}

}  // namespace

void SurfelFeedback::plan(PassPlan& plan, const std::string& pass, const FeedbackParams& params,
                          DirectLight direct, uint32_t lightSamples, const SurfaceVoxels& voxels) {
    params_ = params;
    lightSamples_ = lightSamples;
    sendsShadowRays_ = direct == DirectLight::ByShadowRays || params.bounces > 0;
    // Samples of direct light are free again before those of the bounces begin.
    plan.reserveScratch("voxel samples (estimated)", VoxelAccumulator::plan(plan, pass, params, voxels));
    if (params.bounces > 0) {
        plan.reserveScratch("flux of a bounce (estimated)", bounceBytes(voxels));
        plan.reserveScratch("face irradiance (estimated)", FaceIrradiance::bytes(voxels.voxelCount));
        plan.buffer(rays_, "gather rays", Surfels::kChunk * sizeof(Ray));
        plan.buffer(hits_, "gather ray hits", Surfels::kChunk * sizeof(Hit));
        plan.buffer(surfelsAtHits_, "surfels at hits", Surfels::kChunk * sizeof(gpu::Surfel));
    }
    plan.reserveScratch("areas measured (estimated)", areaBytes(voxels));
    plan.reserve("irradiance (estimated)", VoxelIrradiance::bytes(voxels.voxelCount));
    if (sendsShadowRays_) {
        plan.buffer(measured_, "surfels' direct irradiance", Surfels::kChunk * 4 * sizeof(float));
        light_.plan(plan, Surfels::kChunk);
    }
}

void SurfelFeedback::prepare(PassSetup& setup) {
    direct_ = VoxelAccumulator(setup.device, setup.compiler, params_);
    indirect_ = VoxelAccumulator(setup.device, setup.compiler, params_);
    faces_ = FaceIrradiance(setup.device, setup.compiler);
    if (sendsShadowRays_) light_.prepare(setup);
    const auto program = [&](const char* file, const Defines& defines = {}) {
        return makeComputeProgram(setup.device, setup.compiler.compile(file, defines));
    };
    const Defines writes = VoxelAccumulator::defines(params_.write);
    write_ = program("passes/common/surfels/surfel_write.comp", writes);
    gather_ = program("passes/common/surfels/surfel_gather.comp");
    hitSurfels_ = program("passes/common/surfels/surfel_hits.comp");
    firstBounce_ = program("passes/common/surfels/surfel_first_bounce.comp", writes);
    feedback_ = program("passes/common/surfels/surfel_feedback.comp", writes);
    add_ = program("passes/common/voxels/flux_add.comp");
    fillUnknown_ = program("passes/common/voxels/fill_unknown.comp");
}

void SurfelFeedback::begin(PassContext& context, const SurfaceVoxels& voxels,
                           const std::vector<LightSource>& sources, VoxelIrradiance& irradiance) {
    irradiance.allocate(context.device, voxels.voxelCount);
    context.stream.fill(irradiance.area, 0);
    context.stream.fill(irradiance.indirect, 0);
    typicalIrradiance_ = meanIrradiance(sources, context.frame.scene->geometry);
    direct_.begin(context.device, context.stream, voxels, typicalIrradiance_);
}

void SurfelFeedback::measureDirect(PassContext& context, const Surfels::Chunk& chunk,
                                   const std::vector<LightSource>& sources, uint32_t seed) {
    light_.measure(context, sources, chunk.surfels, chunk.count, lightSamples_, seed, measured_);
    addDirect(context, chunk, measured_);
}

void SurfelFeedback::addDirect(PassContext& context, const Surfels::Chunk& chunk,
                               const Buffer& direct) const {
    std::vector<Binding> bindings = direct_.bindings();
    bindings.insert(bindings.end(), {{"surfels", chunk.surfels}, {"irradiance", direct}});
    context.stream.dispatch(write_, bindings, WritePush{chunk.count, direct_.scale()},
                            linearGroups(chunk.count));
}

void SurfelFeedback::finish(PassContext& context, const SurfaceVoxels& voxels, const Surfels& surfels,
                            const std::vector<LightSource>& sources, uint32_t seed,
                            const VoxelIrradiance& irradiance) {
    CommandStream& stream = context.stream;
    direct_.resolve(stream, voxels, irradiance.direct, irradiance.area);
    requireLight(stream, voxels, irradiance);
    direct_.end();
    bounce(context, voxels, surfels, sources, seed, irradiance);
    fillUnknown(context, voxels, irradiance);
}

void SurfelFeedback::bounce(PassContext& context, const SurfaceVoxels& voxels, const Surfels& surfels,
                            const std::vector<LightSource>& sources, uint32_t seed,
                            const VoxelIrradiance& irradiance) {
    if (params_.bounces == 0) return;
    CommandStream& stream = context.stream;
    bounce_ = LargeBuffer(context.device, "flux of a bounce", bounceBytes(voxels));
    for (uint32_t bounce = 0; bounce < params_.bounces; ++bounce) {
        // What reflects light to each surfel: direct light at first, then what the last bounce brought.
        const uint32_t bounceSeed = seed + 0x51u + bounce * 0x9e3779b9u;
        if (bounce > 0) faces_.update(stream, voxels, irradiance.area, bounce_);
        indirect_.begin(context.device, stream, voxels, typicalIrradiance_);
        for (const Surfels::Chunk& chunk : surfels.chunks) {
            for (uint32_t ray = 0; ray < params_.raysPerPoint; ++ray) {
                trace(context, chunk, ray, bounceSeed);
                if (bounce == 0)
                    firstBounce(context, chunk, ray, sources, bounceSeed + 0xa3u);
                else
                    laterBounce(context, chunk, voxels);
            }
        }

        // Add it to the sum of all bounces.
        indirect_.resolve(stream, voxels, bounce_, irradiance.area);
        const uint32_t pairs = voxels.voxelCount * kFaces / 2;
        stream.dispatch(add_, {{"AddedAt", bounce_.at()}, {"SumAt", irradiance.indirect.at()}}, pairs,
                        linearGroups(pairs));
        stream.finish();
    }
    indirect_.end();
    faces_.end();
    bounce_ = {};
}

void SurfelFeedback::fillUnknown(PassContext& context, const SurfaceVoxels& voxels,
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

void SurfelFeedback::trace(PassContext& context, const Surfels::Chunk& chunk, uint32_t ray,
                           uint32_t seed) const {
    context.stream.dispatch(gather_, {{"surfels", chunk.surfels}, {"rays", rays_}},
                            GatherPush{chunk.count, ray, params_.raysPerPoint, seed},
                            linearGroups(chunk.count));
    context.tracer.closestHit(context.stream, rays_, hits_, chunk.count);
}

void SurfelFeedback::firstBounce(PassContext& context, const Surfels::Chunk& chunk, uint32_t ray,
                                 const std::vector<LightSource>& sources, uint32_t seed) const {
    context.stream.dispatch(
        hitSurfels_,
        context.scene.bindings({{"surfels", chunk.surfels}, {"hits", hits_}, {"hitSurfels", surfelsAtHits_}}),
        HitPush{chunk.count, ray, params_.raysPerPoint}, linearGroups(chunk.count));
    light_.measure(context, sources, surfelsAtHits_, chunk.count, lightSamples_, seed, measured_);
    std::vector<Binding> bindings = indirect_.bindings();
    bindings.insert(bindings.end(),
                    {{"surfels", chunk.surfels}, {"hitSurfels", surfelsAtHits_}, {"hitDirect", measured_}});
    context.stream.dispatch(firstBounce_, bindings, WritePush{chunk.count, indirect_.scale()},
                            linearGroups(chunk.count));
}

void SurfelFeedback::laterBounce(PassContext& context, const Surfels::Chunk& chunk,
                                 const SurfaceVoxels& voxels) const {
    std::vector<Binding> bindings = voxels.bindings(context.scene.bindings(
        {{"faceIrradiance", faces_.buffer()}, {"surfels", chunk.surfels}, {"hits", hits_}}));
    const std::vector<Binding> writes = indirect_.bindings();
    bindings.insert(bindings.end(), writes.begin(), writes.end());
    context.stream.dispatch(feedback_, bindings, FeedbackPush{voxels.grid, chunk.count, indirect_.scale()},
                            linearGroups(chunk.count));
}

}  // namespace voxray
