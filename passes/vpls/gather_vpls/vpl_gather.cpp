#include "passes/vpls/gather_vpls/vpl_gather.h"

#include <algorithm>

#include "passes/common/compute/random_seed.h"
#include "passes/hybrid_leaves/hybrid_types.h"

namespace voxray {
namespace {

constexpr uint32_t kBatchRays = 1u << 20;  // Bounds the memory of rays and contributions to 52 MiB.

const char* defineOf(VplGather::DimLights kind) {
    if (kind == VplGather::DimLights::Sampled) return "ROULETTE";
    return kind == VplGather::DimLights::LeftOut ? "EARLY_OUT" : "EARLY_OUT_BY_POWER";
}

}  // namespace

VplGather::Programs::Programs(ProgramOwner& owner, const Defines& defines)
    : computeMean(owner, "mean_unoccluded_irradiance.comp", defines),
      generateRays(owner, "generate_shadow_rays.comp", defines),
      testShadowMaps(owner, "test_shadow_maps.comp", defines),
      accumulate(owner, "accumulate_irradiance.comp", defines) {}

VplGather::VplGather(ProgramOwner& owner)
    : texelPrograms_(owner, {}), surfelPrograms_(owner, {{"SURFELS", "1"}}), meanPower_(owner, "mean_power.comp") {}

void VplGather::plan(PassPlan& plan, const Settings& settings, glm::uvec2 texels, uint64_t maxVpls) {
    settings_ = settings;
    define(texelPrograms_, true);
    define(surfelPrograms_, settings.gathersAtSurfels);
    meanPower_.compileIf(settings.culling.threshold > 0 && settings.culling.kind == DimLights::LeftOutByPower);
    const glm::uvec2 extent = (texels + settings.block - 1u) / settings.block;
    const uint64_t receiversPerSubset = std::min(extent.x * extent.y, kBatchRays);
    const uint64_t rays = std::min(receiversPerSubset * (maxVpls / subsetCount() + 1), uint64_t(kBatchRays));
    plan.buffer(rays_, "shadow rays", rays * sizeof(Ray));
    if (settings.writesStarts) plan.buffer(starts_, "starts of shadow rays", rays * sizeof(gpu::RayStart));
    plan.buffer(contributions_, "light of virtual point lights", rays * 4 * sizeof(float));
    if (settings.culling.threshold > 0)
        plan.buffer(meanLuminance_, "mean light of virtual point lights", receiversPerSubset * sizeof(float));
    plan.buffer(occluded_, "shadow ray results", rays * sizeof(uint32_t));
}

void VplGather::define(Programs& programs, bool isUsed) const {
    const bool cullsDimLights = settings_.culling.threshold > 0;
    Defines defines;
    if (cullsDimLights) defines.emplace(defineOf(settings_.culling.kind), "1");
    if (settings_.writesStarts) defines.emplace("STARTS", "1");
    for (Kernel* kernel : {&programs.computeMean, &programs.generateRays, &programs.accumulate})
        kernel->define(defines);
    if (settings_.shadowMaps) defines.merge(settings_.shadowMaps->defines());
    programs.testShadowMaps.define(defines);

    programs.computeMean.compileIf(isUsed && cullsDimLights && settings_.culling.kind != DimLights::LeftOutByPower);
    programs.generateRays.compileIf(isUsed);
    programs.testShadowMaps.compileIf(isUsed && settings_.shadowMaps);
    programs.accumulate.compileIf(isUsed);
}

void VplGather::gatherAtTexels(PassContext& context, const Vpls& vpls, const Visibility& visibility,
                               const GBuffer& gbuffer, const VplTarget& target) const {
    gpu::VplBatch batch{};
    batch.receiverExtent = gbufferExtent(context.frame, gbuffer.samples);
    const glm::uvec2 extent = (batch.receiverExtent + settings_.block - 1u) / settings_.block;
    gather(context, vpls, visibility, batch, extent.x * extent.y, texelPrograms_, gbuffer.bindings(),
           {{"irradiance", target.irradiance}, {"texelMoments", target.texelMoments}});
}

void VplGather::gatherAtSurfels(PassContext& context, const Vpls& vpls, const Visibility& visibility,
                                const Buffer& surfels, const Buffer& faceNormals, uint32_t count, uint32_t reflections,
                                const Buffer& irradiance) const {
    gpu::VplBatch batch{};
    batch.receiverExtent = {count, 1};
    batch.reflections = reflections;
    gather(context, vpls, visibility, batch, (count + subsetCount() - 1) / subsetCount(), surfelPrograms_,
           {{"surfels", surfels}, {"faceNormals", faceNormals}}, {{"irradiance", irradiance}});
}

void VplGather::recordMean(PassContext& context, const Vpls& vpls, const gpu::VplBatch& subset,
                           const Programs& programs, const std::vector<Binding>& receiverBindings) const {
    const Bindings shared{{"VplsRef", vpls.points.ref()},
                          {"activeVpls", vpls.activeIndices},
                          {"meanLuminance", meanLuminance_},
                          {"batch", subset}};
    if (settings_.culling.kind == DimLights::LeftOutByPower)
        context.stream.dispatch(meanPower_, 1, shared);
    else
        context.stream.dispatch(
            programs.computeMean, subset.receiverCount,
            {context.scene, receiverBindings, shared.all(), {"minDistanceSquared", settings_.minDistanceSquared}});
}

void VplGather::gather(PassContext& context, const Vpls& vpls, const Visibility& visibility, gpu::VplBatch batch,
                       uint32_t receiversPerSubset, const Programs& programs,
                       const std::vector<Binding>& receiverBindings, const std::vector<Binding>& targetBindings) const {
    CommandStream& stream = context.stream;
    const auto maxRays = uint32_t(occluded_.bytes() / sizeof(uint32_t));
    const VplShadowMaps* shadowMaps = settings_.shadowMaps;
    if (!visibility.tracer && !shadowMaps) stream.fill(occluded_, 0);
    const Bindings lights{receiverBindings, {"VplsRef", vpls.points.ref()}, {"activeVpls", vpls.activeIndices}};
    batch.block = settings_.block;
    batch.bounces = vpls.bounces;

    // One subset after the other: its shadow rays lie next to each other
    for (batch.subset = 0; batch.subset < subsetCount(); ++batch.subset) {
        // Ranges of the active lights; their lengths differ by one at most
        const auto firstVpl = uint32_t(uint64_t(vpls.activeCount) * batch.subset / subsetCount());
        const auto endVpl = uint32_t(uint64_t(vpls.activeCount) * (batch.subset + 1) / subsetCount());
        for (batch.firstReceiver = 0; batch.firstReceiver < receiversPerSubset;
             batch.firstReceiver += batch.receiverCount) {
            batch.receiverCount = std::min(receiversPerSubset - batch.firstReceiver, maxRays);
            uint32_t maxVpls = maxRays / batch.receiverCount;
            if (shadowMaps) maxVpls = std::min(maxVpls, shadowMaps->capacity());
            if (settings_.culling.threshold > 0 && firstVpl < endVpl) {
                gpu::VplBatch wholeSubset = batch;
                wholeSubset.firstVpl = firstVpl;
                wholeSubset.vplCount = endVpl - firstVpl;
                recordMean(context, vpls, wholeSubset, programs, receiverBindings);
            }
            for (batch.firstVpl = firstVpl; batch.firstVpl < endVpl; batch.firstVpl += batch.vplCount) {
                batch.vplCount = std::min(endVpl - batch.firstVpl, maxVpls);
                const uint32_t rays = batch.receiverCount * batch.vplCount;
                stream.dispatch(programs.generateRays, rays,
                                {context.scene,
                                 lights.all(),
                                 {"rays", rays_},
                                 {"contributions", contributions_},
                                 ifUsed({"starts", starts_}),
                                 ifUsed({"meanLuminance", meanLuminance_}),
                                 {"batch", batch},
                                 {"minDistanceSquared", settings_.minDistanceSquared},
                                 {"seed", randomSeed(context.frame, 0xa1u)},
                                 {"cullThreshold", settings_.culling.threshold},
                                 {"grid", visibility.grid},
                                 {"endEpsilon", settings_.endEpsilon}});
                if (shadowMaps) {
                    shadowMaps->render(context, vpls, batch.firstVpl, batch.vplCount);
                    stream.dispatch(programs.testShadowMaps, rays,
                                    {lights.all(),
                                     {"rays", rays_},
                                     shadowMaps->bindings(),
                                     {"occluded", occluded_},
                                     {"batch", batch},
                                     {"resolution", shadowMaps->resolution()}});
                } else if (visibility.tracer) {
                    visibility.tracer->occluded(stream, rays_, occluded_, rays, Coherence::Coherent);
                }
                stream.dispatch(
                    programs.accumulate, batch.receiverCount,
                    {targetBindings, {"contributions", contributions_}, {"occluded", occluded_}, {"batch", batch}});
            }
        }
    }
}

}  // namespace voxray
