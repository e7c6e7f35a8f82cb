#include "passes/vpls/gather_vpls/compensation.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "passes/common/compute/random_seed.h"

namespace voxray {
namespace {

constexpr uint32_t kBatchTexels = 1u << 17;  // Bounds the memory to 32 MiB.

}  // namespace

VplCompensation::VplCompensation(ProgramOwner& owner)
    : direct_(owner),
      begin_(owner, "compensate_begin.comp"),
      aim_(owner, "compensate_aim.comp"),
      flag_(owner, "compensate_flag.comp"),
      hit_(owner, "compensate_hit.comp"),
      add_(owner, "compensate_add.comp"),
      compaction_(owner) {}

void VplCompensation::plan(PassPlan& plan, const Settings& settings, glm::uvec2 texels) {
    settings_ = settings;
    sources_ = lightSources(*plan.frame.scene);
    const uint32_t batch = std::min(texels.x * texels.y, kBatchTexels);
    direct_.plan(plan, batch);
    for (Ends* ends : {&from_, &to_}) {
        plan.scratchBuffer(ends->surfels, "surfels within the bound", uint64_t(batch) * sizeof(gpu::Surfel));
        plan.scratchBuffer(ends->faceNormals, "their faces' normals", uint64_t(batch) * sizeof(uint32_t));
    }
    plan.scratchBuffer(rays_, "rays within the bound", uint64_t(batch) * sizeof(Ray));
    plan.scratchBuffer(hits_, "their hits", uint64_t(batch) * sizeof(Hit));
    plan.scratchBuffer(flags_, "flags of rays that hit", (uint64_t(batch) + 31) / 32 * sizeof(uint32_t));
    plan.scratchBuffer(list_, "list of rays that hit", uint64_t(batch) * sizeof(uint32_t));
    plan.scratchBuffer(arriving_, "irradiance within the bound", uint64_t(batch) * 4 * sizeof(float));
}

void VplCompensation::record(PassContext& context, const Vpls& vpls, const VplLight& light,
                             const VplLight::Visibility& visibility, const GBuffer& gbuffer,
                             const VplTarget& target) {
    const glm::uvec2 extent = gbufferExtent(context.frame, gbuffer.samples);
    const uint32_t texels = extent.x * extent.y, batch = uint32_t(hits_.bytes() / sizeof(Hit));
    for (uint32_t first = 0; first < texels; first += batch)
        for (uint32_t ray = 0; ray < settings_.rays; ++ray) {
            uint32_t count = std::min(texels - first, batch);
            context.dispatch(begin_, count,
                             {gbuffer,
                              {"surfels", from_.surfels},
                              {"faceNormals", from_.faceNormals},
                              {"first", first},
                              {"count", count},
                              {"ray", ray},
                              {"rays", settings_.rays}});

            // What surfels reflect, hit after hit: direct light, and virtual lights of all bounces but as
            // many last ones as there were hits.
            for (uint32_t reflections = 1; reflections <= settings_.bounces; ++reflections) {
                const uint32_t seed = randomSeed(context.frame, 0x71u + reflections);
                count = step(context, count, seed);
                if (count == 0) break;
                direct_.measure(context, sources_, from_.surfels, count, 1, seed + 0x35u, arriving_);
                light.addToSurfels(context, vpls, visibility, from_.surfels, from_.faceNormals, count,
                                   reflections, arriving_);
                context.dispatch(add_, count,
                                 {{"surfels", from_.surfels},
                                  {"arriving", arriving_},
                                  {"irradiance", target.irradiance},
                                  {"sums", target.sums},
                                  {"count", count},
                                  {"rays", settings_.rays},
                                  {"radius", std::sqrt(settings_.minDistanceSquared)}});
            }
        }
}

uint32_t VplCompensation::step(PassContext& context, uint32_t count, uint32_t seed) {
    context.dispatch(aim_, count,
                     {context.scene,
                      {"surfels", from_.surfels},
                      {"faceNormals", from_.faceNormals},
                      {"rays", rays_},
                      {"count", count},
                      {"seed", seed},
                      {"radius", std::sqrt(settings_.minDistanceSquared)}});
    context.tracer.closestHit(context.stream, rays_, hits_, count);

    // Few rays hit: from here on there are only these.
    const uint32_t words = (count + 31) / 32;
    context.dispatch(flag_, words, {{"hits", hits_}, {"flags", flags_}, {"count", count}});
    const uint32_t hits = compaction_.run(context.stream, flags_, list_, words);
    context.dispatch(hit_, hits,
                     {context.scene,
                      {"list", list_},
                      {"hits", hits_},
                      {"from", from_.surfels},
                      {"surfels", to_.surfels},
                      {"faceNormals", to_.faceNormals},
                      {"count", hits},
                      {"minDistanceSquared", settings_.minDistanceSquared}});
    std::swap(from_, to_);
    return hits;
}

}  // namespace voxray
