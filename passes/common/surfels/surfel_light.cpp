#include "passes/common/surfels/surfel_light.h"

#include "passes/common/compute/dispatch.h"

namespace voxray {
namespace {

struct AimPush {
    uint32_t count;
    uint32_t kind;
    uint32_t light;
    uint32_t samples;
    uint32_t emitterCount;
    uint32_t seed;
};

}  // namespace

void SurfelLight::plan(PassPlan& plan, uint32_t batch) {
    plan.buffer(rays_, "shadow rays", uint64_t(batch) * sizeof(Ray));
    plan.buffer(carried_, "shadow ray irradiance", uint64_t(batch) * 4 * sizeof(float));
    plan.buffer(occluded_, "shadow ray results", uint64_t(batch) * sizeof(uint32_t));
    tint_.plan(plan, batch);
}

void SurfelLight::prepare(PassSetup& setup) {
    aim_ = makeComputeProgram(setup.device, setup.compiler.compile("passes/common/surfels/surfel_aim.comp"));
    add_ = makeComputeProgram(setup.device, setup.compiler.compile("passes/common/surfels/surfel_add.comp"));
    tint_.prepare(setup);
}

void SurfelLight::measure(PassContext& context, const std::vector<LightSource>& sources,
                          const Buffer& surfels, uint32_t count, uint32_t samples, uint32_t seed,
                          const Buffer& direct) const {
    CommandStream& stream = context.stream;
    stream.fill(direct, 0);
    for (const LightSource& source : sources) {
        const bool punctual = source.kind == LightSource::Punctual;
        for (uint32_t s = 0; s < (punctual ? 1 : samples); ++s) {
            stream.dispatch(
                aim_, context.scene.bindings({{"surfels", surfels}, {"rays", rays_}, {"carried", carried_}}),
                AimPush{count, source.kind, punctual ? source.light : s, samples, context.scene.emitterCount,
                        seed + source.kind},
                linearGroups(count));
            context.tracer.occluded(stream, rays_, occluded_, count);
            tint_.apply(context, rays_, carried_, 4, count);
            stream.dispatch(add_, {{"carried", carried_}, {"occluded", occluded_}, {"direct", direct}}, count,
                            linearGroups(count));
        }
    }
}

}  // namespace voxray
