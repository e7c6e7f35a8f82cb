#include "passes/surfels/surfel_direct_light.h"

namespace voxray {
namespace {

/// For a sample of an environment map (shaders/lights/lights.glsl): one by its radiance, one by cosine.
constexpr uint32_t kEnvironmentCandidates = 2;

}  // namespace

SurfelDirectLight::SurfelDirectLight(ProgramOwner& owner)
    : generateRays_(owner, "generate_shadow_rays.comp"),
      accumulate_(owner, "accumulate_direct_light.comp"),
      paneTransmittance_(owner) {}

void SurfelDirectLight::plan(PassPlan& plan, uint32_t maxSurfels) {
    plan.buffer(rays_, "shadow rays", uint64_t(maxSurfels) * sizeof(Ray));
    plan.buffer(contributions_, "shadow ray irradiance", uint64_t(maxSurfels) * 4 * sizeof(float));
    plan.buffer(occluded_, "shadow ray results", uint64_t(maxSurfels) * sizeof(uint32_t));
    paneTransmittance_.plan(plan, maxSurfels);
}

void SurfelDirectLight::measure(PassContext& context, const std::vector<LightSource>& sources, const Buffer& surfels,
                                uint32_t count, uint32_t samples, uint32_t seed, const Buffer& direct) const {
    CommandStream& stream = context.stream;
    stream.fill(direct, 0);
    for (const LightSource& source : shadowRaySources(sources, *context.frame.scene)) {
        const bool punctual = source.kind == LightSource::Punctual;
        for (uint32_t s = 0; s < (punctual ? 1 : samples); ++s) {
            context.dispatch(generateRays_, count,
                             {context.scene,
                              {"surfels", surfels},
                              {"rays", rays_},
                              {"contributions", contributions_},
                              {"count", count},
                              {"kind", source.kind},
                              {"light", punctual ? source.light : s},
                              {"samples", samples},
                              {"candidates", source.kind == LightSource::Environment ? kEnvironmentCandidates : 1},
                              {"emitterCount", context.scene.emitterCount},
                              {"emitterRoot", context.scene.emitterRoot},
                              {"seed", seed + source.kind}});
            context.tracer.occluded(stream, rays_, occluded_, count);
            paneTransmittance_.apply(context, rays_, contributions_, 4, count);
            context.dispatch(
                accumulate_, count,
                {{"contributions", contributions_}, {"occluded", occluded_}, {"direct", direct}, {"count", count}});
        }
    }
}

}  // namespace voxray
