#include "passes/inject/light_paths/light_emission.h"

#include "passes/inject/light_paths/light_path_types.h"

namespace voxray {
namespace {

/// In radii of the region's sphere. Farther out floats are more than 10⁻⁵ of a radius apart.
constexpr float kFarRadii = 256;

bool isParallel(const LightSource& source, const SceneState& scene) {
    return source.kind == LightSource::Environment ||
           (source.kind == LightSource::Punctual && scene.lights[source.light].type == LightType::Directional);
}

}  // namespace

LightEmission::LightEmission(ProgramOwner& owner)
    : emit_(owner, "light_emission.comp"),
      generateBackRays_(owner, "generate_back_rays.comp"),
      drop_(owner, "drop_occluded_light_rays.comp") {}

void LightEmission::plan(PassPlan& plan, uint64_t rays) {
    const BoundingSphere sphere = boundingSphere(plan.frame.scene->geometry);
    extendsFar_ = sphere.reach > kFarRadii * sphere.radius;
    for (Kernel* kernel : {&generateBackRays_, &drop_}) kernel->compileIf(extendsFar_);
    if (!extendsFar_) return;
    plan.scratchBuffer(backRays_, "rays back to the light", rays * sizeof(Ray));
    plan.scratchBuffer(occluded_, "rays that surfaces far out occlude", rays * sizeof(uint32_t));
}

void LightEmission::emit(PassContext& context, const LightSource& source, const Batch& batch, const Buffer& rays,
                         const Buffer& paths) const {
    const SceneState& scene = *context.frame.scene;
    const BoundingSphere sphere = boundingSphere(scene.geometry);
    const bool startsInside = extendsFar_ && isParallel(source, scene);
    const gpu::EmittingSource emitting{
        source.kind,   source.light, context.scene.emitterCount,
        batch.rays,    batch.seed,   sphere.center,
        sphere.radius, sphere.reach, startsInside ? RING_RADII * sphere.radius : sphere.reach};
    context.dispatch(emit_, batch.count,
                     {context.scene,
                      {"rays", rays},
                      {"paths", paths},
                      {"source", emitting},
                      {"firstRay", batch.first},
                      {"batchRays", batch.count}});
    if (startsInside) dropOccluded(context, sphere.reach, batch.count, rays, paths);
}

void LightEmission::dropOccluded(PassContext& context, float reach, uint32_t count, const Buffer& rays,
                                 const Buffer& paths) const {
    context.dispatch(generateBackRays_, count,
                     {{"rays", rays}, {"backRays", backRays_}, {"count", count}, {"length", 2 * reach}});
    context.tracer.occluded(context.stream, backRays_, occluded_, count);
    context.dispatch(drop_, count, {{"occluded", occluded_}, {"rays", rays}, {"paths", paths}, {"count", count}});
}

}  // namespace voxray
