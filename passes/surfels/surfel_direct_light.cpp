#include "passes/surfels/surfel_direct_light.h"

namespace voxray {

SurfelDirectLight::SurfelDirectLight(ProgramOwner& owner)
    : aim_(owner, "generate_shadow_rays.comp"),
      add_(owner, "accumulate_direct_light.comp"),
      paneTransmittance_(owner) {}

void SurfelDirectLight::plan(PassPlan& plan, uint32_t batch) {
    plan.buffer(rays_, "shadow rays", uint64_t(batch) * sizeof(Ray));
    plan.buffer(carried_, "shadow ray irradiance", uint64_t(batch) * 4 * sizeof(float));
    plan.buffer(occluded_, "shadow ray results", uint64_t(batch) * sizeof(uint32_t));
    paneTransmittance_.plan(plan, batch);
}

void SurfelDirectLight::measure(PassContext& context, const std::vector<LightSource>& sources,
                                const Buffer& surfels, uint32_t count, uint32_t samples, uint32_t seed,
                                const Buffer& direct) const {
    CommandStream& stream = context.stream;
    stream.fill(direct, 0);
    for (const LightSource& source : sources) {
        const bool punctual = source.kind == LightSource::Punctual;
        for (uint32_t s = 0; s < (punctual ? 1 : samples); ++s) {
            context.dispatch(aim_, count,
                             {context.scene,
                              {"surfels", surfels},
                              {"rays", rays_},
                              {"carried", carried_},
                              {"count", count},
                              {"kind", source.kind},
                              {"light", punctual ? source.light : s},
                              {"samples", samples},
                              {"emitterCount", context.scene.emitterCount},
                              {"seed", seed + source.kind}});
            context.tracer.occluded(stream, rays_, occluded_, count);
            paneTransmittance_.apply(context, rays_, carried_, 4, count);
            context.dispatch(
                add_, count,
                {{"carried", carried_}, {"occluded", occluded_}, {"direct", direct}, {"count", count}});
        }
    }
}

}  // namespace voxray
