#include "passes/vpls/gather_vpls/vpl_light.h"

#include <algorithm>

#include "passes/common/compute/random_seed.h"
#include "passes/hybrid_leaves/hybrid_types.h"

namespace voxray {
namespace {

constexpr uint32_t kBatchRays = 1u << 20;  // Bounds the memory of rays and what they carry to 52 MiB.

}  // namespace

VplLight::Programs::Programs(ProgramOwner& owner, const Defines& defines)
    : mean(owner, "mean.comp", defines),
      aim(owner, "aim.comp", defines),
      shadows(owner, "map_shadows.comp", defines),
      add(owner, "add.comp", defines) {}

VplLight::VplLight(ProgramOwner& owner) : texels_(owner, {}), surfels_(owner, {{"SURFELS", "1"}}) {}

void VplLight::plan(PassPlan& plan, const Settings& settings, glm::uvec2 texels, uint64_t maxVpls) {
    settings_ = settings;
    define(texels_, true);
    define(surfels_, settings.surfels);
    const glm::uvec2 extent = (texels + settings.block - 1u) / settings.block;
    const uint64_t perSubset = std::min(extent.x * extent.y, kBatchRays);
    const uint64_t rays = std::min(perSubset * (maxVpls / subsets() + 1), uint64_t(kBatchRays));
    plan.buffer(rays_, "shadow rays", rays * sizeof(Ray));
    if (settings.starts) plan.buffer(starts_, "starts of shadow rays", rays * sizeof(gpu::RayStart));
    plan.buffer(carried_, "light of virtual point lights", rays * 4 * sizeof(float));
    if (settings.dim.below > 0)
        plan.buffer(means_, "mean light of virtual point lights", perSubset * sizeof(float));
    plan.buffer(occluded_, "shadow ray results", rays * sizeof(uint32_t));
}

void VplLight::define(Programs& programs, bool isUsed) const {
    const bool leavesDim = settings_.dim.below > 0;
    Defines defines;
    if (leavesDim) defines.emplace(settings_.dim.isByChance ? "ROULETTE" : "EARLY_OUT", "1");
    if (settings_.starts) defines.emplace("STARTS", "1");
    for (Kernel* kernel : {&programs.mean, &programs.aim, &programs.add}) kernel->define(defines);
    if (settings_.maps) defines.merge(settings_.maps->defines());
    programs.shadows.define(defines);

    programs.mean.compileIf(isUsed && leavesDim);
    programs.aim.compileIf(isUsed);
    programs.shadows.compileIf(isUsed && settings_.maps);
    programs.add.compileIf(isUsed);
}

void VplLight::addToTexels(PassContext& context, const Vpls& vpls, const Visibility& visibility,
                           const GBuffer& gbuffer, const VplTarget& target) const {
    gpu::VplBatch batch{};
    batch.receivers = gbufferExtent(context.frame, gbuffer.samples);
    const glm::uvec2 extent = (batch.receivers + settings_.block - 1u) / settings_.block;
    add(context, vpls, visibility, batch, extent.x * extent.y, texels_, gbuffer.bindings(),
        {{"irradiance", target.irradiance}, {"sums", target.sums}});
}

void VplLight::addToSurfels(PassContext& context, const Vpls& vpls, const Visibility& visibility,
                            const Buffer& surfels, const Buffer& faceNormals, uint32_t count,
                            uint32_t reflections, const Buffer& irradiance) const {
    gpu::VplBatch batch{};
    batch.receivers = {count, 1};
    batch.reflections = reflections;
    add(context, vpls, visibility, batch, (count + subsets() - 1) / subsets(), surfels_,
        {{"surfels", surfels}, {"faceNormals", faceNormals}}, {{"irradiance", irradiance}});
}

void VplLight::add(PassContext& context, const Vpls& vpls, const Visibility& visibility, gpu::VplBatch batch,
                   uint32_t perSubset, const Programs& programs, const std::vector<Binding>& receivers,
                   const std::vector<Binding>& target) const {
    CommandStream& stream = context.stream;
    const auto maxRays = uint32_t(occluded_.bytes() / sizeof(uint32_t));
    const VplMaps* maps = settings_.maps;
    if (!visibility.tracer && !maps) stream.fill(occluded_, 0);
    const Bindings lights{receivers, {"VplsAt", vpls.points.at()}, {"list", vpls.list}};
    batch.block = settings_.block;
    batch.bounces = vpls.bounces;

    // Receivers and virtual lights of one subset after the other: their rays lie next to each other.
    for (batch.subset = 0; batch.subset < subsets(); ++batch.subset) {
        // Runs of the list that differ in length by one at most
        const auto begin = uint32_t(uint64_t(vpls.count) * batch.subset / subsets());
        const auto end = uint32_t(uint64_t(vpls.count) * (batch.subset + 1) / subsets());
        for (batch.first = 0; batch.first < perSubset; batch.first += batch.count) {
            batch.count = std::min(perSubset - batch.first, maxRays);
            uint32_t maxVpls = maxRays / batch.count;
            if (maps) maxVpls = std::min(maxVpls, maps->capacity());
            if (settings_.dim.below > 0 && begin < end) {
                gpu::VplBatch all = batch;
                all.firstVpl = begin;
                all.vplCount = end - begin;
                stream.dispatch(programs.mean, batch.count,
                                {context.scene,
                                 lights.all(),
                                 {"means", means_},
                                 {"batch", all},
                                 {"minDistanceSquared", settings_.minDistanceSquared}});
            }
            for (batch.firstVpl = begin; batch.firstVpl < end; batch.firstVpl += batch.vplCount) {
                batch.vplCount = std::min(end - batch.firstVpl, maxVpls);
                const uint32_t rays = batch.count * batch.vplCount;
                stream.dispatch(programs.aim, rays,
                                {context.scene,
                                 lights.all(),
                                 {"rays", rays_},
                                 {"carried", carried_},
                                 ifUsed({"starts", starts_}),
                                 ifUsed({"means", means_}),
                                 {"batch", batch},
                                 {"minDistanceSquared", settings_.minDistanceSquared},
                                 {"seed", randomSeed(context.frame, 0xa1u)},
                                 {"dim", settings_.dim.below},
                                 {"grid", visibility.grid},
                                 {"endEpsilon", settings_.endEpsilon}});
                if (maps) {
                    maps->draw(context, vpls, batch.firstVpl, batch.vplCount);
                    stream.dispatch(programs.shadows, rays,
                                    {lights.all(),
                                     {"rays", rays_},
                                     maps->binding(),
                                     {"occluded", occluded_},
                                     {"batch", batch},
                                     {"resolution", maps->resolution()}});
                } else if (visibility.tracer) {
                    visibility.tracer->occluded(stream, rays_, occluded_, rays, Coherence::Coherent);
                }
                stream.dispatch(programs.add, batch.count,
                                {target, {"carried", carried_}, {"occluded", occluded_}, {"batch", batch}});
            }
        }
    }
}

}  // namespace voxray
