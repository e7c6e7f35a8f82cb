#include "passes/probes/update_probes/probe_light.h"

namespace voxray {

ProbeLight::ProbeLight(Pass& pass, ProbeSource source)
    : source_(source),
      voxels_(pass, "voxels", "surface voxels", source == ProbeSource::Voxels),
      irradiance_(pass, "irradiance", "light that arrives at the voxels' surfaces", source == ProbeSource::Voxels),
      shade_(pass, "shade_probe_hits.comp", source == ProbeSource::Voxels ? Defines{{"FROM_VOXELS", "1"}} : Defines{}),
      addDirect_(pass, "add_direct_light.comp") {
    if (source == ProbeSource::Voxels)
        faces_.emplace(pass);
    else
        direct_.emplace(pass);
}

void ProbeLight::plan(PassPlan& plan, uint32_t rays, uint32_t lightSamples, bool backsAreDark) {
    lightSamples_ = lightSamples;
    shade_.specialize({{"kBacksAreDark", backsAreDark}});
    addDirect_.compileIf(source_ == ProbeSource::Probes);
    plan.buffer(light_, "light of probe rays", rays * sizeof(glm::vec4));
    if (!direct_) return;
    sources_ = requireLightSources(*plan.frame.scene, "update_probes");
    direct_->plan(plan, rays);
    plan.buffer(surfels_, "surfels at probe rays' hits", rays * sizeof(gpu::Surfel));
    plan.buffer(directLight_, "direct light at probe rays' hits", rays * sizeof(glm::vec4));
}

std::optional<uint32_t> ProbeLight::voxelBounces(const PassPlan& plan) const {
    return plan[irradiance_].lightBounces;
}

void ProbeLight::update(PassContext& context) {
    if (!faces_ || (!context.changed(voxels_) && !context.changed(irradiance_))) return;
    const VoxelIrradiance& light = context[irradiance_];
    faces_->update(context.stream, context[voxels_], light.area, light.indirect, &light.direct);
}

Binding ProbeLight::shade(PassContext& context, const ProbeRays& rays, const ProbeBatch& batch,
                          const std::vector<Binding>& lookup, uint32_t seed) const {
    const Bindings common{
        context.scene, rays.bindings(), {"light", light_}, {"first", batch.first}, {"rayCount", batch.rays}};
    if (faces_) {
        context.dispatch(shade_, batch.rays, {common.all(), lookup, context[voxels_].bindings({faces_->binding()})});
        return {"light", light_};
    }
    context.dispatch(shade_, batch.rays, {common.all(), lookup, {"surfels", surfels_}});
    direct_->measure(context, sources_, surfels_, batch.rays, lightSamples_, seed, directLight_);
    context.dispatch(addDirect_, batch.rays,
                     {{"surfels", surfels_}, {"direct", directLight_}, {"light", light_}, {"rayCount", batch.rays}});
    return {"light", light_};
}

}  // namespace voxray
