#include "passes/vpls/gather_vpls/compensation.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "passes/common/compute/bit_words.h"
#include "passes/common/compute/random_seed.h"

namespace voxray {
namespace {

constexpr uint32_t kBatchTexels = 1u << 17;  // Bounds the memory to 32 MiB.

}  // namespace

VplCompensation::VplCompensation(ProgramOwner& owner)
    : directLight_(owner),
      initSurfels_(owner, "compensation_init_surfels.comp"),
      generateRays_(owner, "compensation_generate_rays.comp"),
      flagHits_(owner, "compensation_flag_hits.comp"),
      surfelsAtHits_(owner, "compensation_surfels_at_hits.comp"),
      accumulate_(owner, "compensation_accumulate.comp"),
      compaction_(owner) {}

void VplCompensation::plan(PassPlan& plan, const Settings& settings, glm::uvec2 texels) {
    settings_ = settings;
    sources_ = lightSources(*plan.frame.scene);
    const uint32_t batch = std::min(texels.x * texels.y, kBatchTexels);
    directLight_.plan(plan, batch);
    for (PathVertices* vertices : {&current_, &next_}) {
        plan.scratchBuffer(vertices->surfels, "surfels within the bound", uint64_t(batch) * sizeof(gpu::Surfel));
        plan.scratchBuffer(vertices->faceNormals, "their faces' normals", uint64_t(batch) * sizeof(uint32_t));
    }
    plan.scratchBuffer(rays_, "rays within the bound", uint64_t(batch) * sizeof(Ray));
    plan.scratchBuffer(hits_, "their hits", uint64_t(batch) * sizeof(Hit));
    plan.scratchBuffer(flags_, "flags of rays that hit", bitWords(batch) * sizeof(uint32_t));
    plan.scratchBuffer(hitRays_, "list of rays that hit", uint64_t(batch) * sizeof(uint32_t));
    plan.scratchBuffer(surfelIrradiance_, "irradiance within the bound", uint64_t(batch) * 4 * sizeof(float));
}

void VplCompensation::record(PassContext& context, const Vpls& vpls, const VplGather& vplGather,
                             const VplGather::Visibility& visibility, const GBuffer& gbuffer, const VplTarget& target) {
    const glm::uvec2 extent = gbufferExtent(context.frame, gbuffer.samples);
    const uint32_t texels = extent.x * extent.y, batch = uint32_t(hits_.bytes() / sizeof(Hit));
    for (uint32_t first = 0; first < texels; first += batch)
        for (uint32_t ray = 0; ray < settings_.raysPerTexel; ++ray) {
            uint32_t count = std::min(texels - first, batch);
            context.dispatch(initSurfels_, count,
                             {gbuffer,
                              {"surfels", current_.surfels},
                              {"faceNormals", current_.faceNormals},
                              {"first", first},
                              {"count", count},
                              {"rayInTexel", ray},
                              {"raysPerTexel", settings_.raysPerTexel}});

            // The light that surfels reflect, hit after hit: direct light, and virtual lights of all bounces
            // but as many last ones as there were hits.
            for (uint32_t reflections = 1; reflections <= settings_.bounces; ++reflections) {
                const uint32_t seed = randomSeed(context.frame, 0x71u + reflections);
                count = traceBounce(context, count, seed);
                if (count == 0) break;
                directLight_.measure(context, sources_, current_.surfels, count, 1, seed + 0x35u, surfelIrradiance_);
                vplGather.gatherAtSurfels(context, vpls, visibility, current_.surfels, current_.faceNormals, count,
                                          reflections, surfelIrradiance_);
                context.dispatch(accumulate_, count,
                                 {{"surfels", current_.surfels},
                                  {"surfelIrradiance", surfelIrradiance_},
                                  {"irradiance", target.irradiance},
                                  {"texelMoments", target.texelMoments},
                                  {"count", count},
                                  {"raysPerTexel", settings_.raysPerTexel},
                                  {"radius", std::sqrt(settings_.minDistanceSquared)}});
            }
        }
}

uint32_t VplCompensation::traceBounce(PassContext& context, uint32_t count, uint32_t seed) {
    context.dispatch(generateRays_, count,
                     {context.scene,
                      {"surfels", current_.surfels},
                      {"faceNormals", current_.faceNormals},
                      {"rays", rays_},
                      {"count", count},
                      {"seed", seed},
                      {"radius", std::sqrt(settings_.minDistanceSquared)}});
    context.tracer.closestHit(context.stream, rays_, hits_, count);

    // Few rays hit: keep only these.
    const auto words = uint32_t(bitWords(count));
    context.dispatch(flagHits_, words, {{"hits", hits_}, {"flags", flags_}, {"count", count}});
    const uint32_t hits = compaction_.run(context.stream, flags_, hitRays_, words);
    context.dispatch(surfelsAtHits_, hits,
                     {context.scene,
                      {"hitRays", hitRays_},
                      {"hits", hits_},
                      {"previousSurfels", current_.surfels},
                      {"surfels", next_.surfels},
                      {"faceNormals", next_.faceNormals},
                      {"count", hits},
                      {"minDistanceSquared", settings_.minDistanceSquared}});
    std::swap(current_, next_);
    return hits;
}

}  // namespace voxray
