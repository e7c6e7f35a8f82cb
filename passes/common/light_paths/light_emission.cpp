#include "passes/common/light_paths/light_emission.h"

#include "passes/common/compute/dispatch.h"
#include "shaders/light_paths/light_path_types.h"

namespace voxray {
namespace {

struct EmitPush {
    gpu::EmittingSource source;
    uint32_t firstRay;
    uint32_t batchRays;
};

/// In radii of the region's sphere: where surfaces reach farther, the floats out there are more than 10⁻⁵ of
/// a radius apart.
constexpr float kFar = 256;

bool isParallel(const LightSource& source, const SceneState& scene) {
    return source.kind == LightSource::Environment ||
           (source.kind == LightSource::Punctual &&
            scene.lights[source.light].type == LightType::Directional);
}

}  // namespace

void LightEmission::plan(PassPlan& plan, uint64_t rays) {
    const BoundingSphere sphere = boundingSphere(plan.frame.scene->geometry);
    reachesFar_ = sphere.reach > kFar * sphere.radius;
    if (!reachesFar_) return;
    plan.scratchBuffer(backRays_, "rays back to the light", rays * sizeof(Ray));
    plan.scratchBuffer(occluded_, "rays that surfaces far out occlude", rays * sizeof(uint32_t));
}

void LightEmission::prepare(PassSetup& setup) {
    const auto program = [&](const char* file) {
        return makeComputeProgram(setup.device,
                                  setup.compiler.compile(std::string("passes/common/light_paths/") + file));
    };
    emit_ = program("light_emission.comp");
    if (!reachesFar_) return;
    turn_ = program("turn_light_rays.comp");
    drop_ = program("drop_occluded_light_rays.comp");
}

void LightEmission::emit(PassContext& context, const LightSource& source, const Batch& batch,
                         const Buffer& rays, const Buffer& paths) const {
    const SceneState& scene = *context.frame.scene;
    const BoundingSphere sphere = boundingSphere(scene.geometry);
    const bool startsNear = reachesFar_ && isParallel(source, scene);
    const gpu::EmittingSource emitting{
        source.kind,   source.light, context.scene.emitterCount,
        batch.rays,    batch.seed,   sphere.center,
        sphere.radius, sphere.reach, startsNear ? RING_RADII * sphere.radius : sphere.reach};
    context.stream.dispatch(emit_, context.scene.bindings({{"rays", rays}, {"paths", paths}}),
                            EmitPush{emitting, batch.first, batch.count}, linearGroups(batch.count));
    if (startsNear) dropOccluded(context, sphere.reach, batch.count, rays, paths);
}

void LightEmission::dropOccluded(PassContext& context, float reach, uint32_t count, const Buffer& rays,
                                 const Buffer& paths) const {
    context.stream.dispatch(
        turn_, count, {{"rays", rays}, {"backRays", backRays_}, {"count", count}, {"length", 2 * reach}});
    context.tracer.occluded(context.stream, backRays_, occluded_, count);
    context.stream.dispatch(drop_, count,
                            {{"occluded", occluded_}, {"rays", rays}, {"paths", paths}, {"count", count}});
}

}  // namespace voxray
