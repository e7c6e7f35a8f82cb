#include "passes/gather_vpls/compensation.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "passes/common/compute/dispatch.h"
#include "passes/common/compute/random_seed.h"
#include "passes/common/view/frame_image.h"

namespace voxray {
namespace {

constexpr uint32_t kBatchTexels = 1u << 17;  // Bounds the memory to 32 MiB.

struct BeginCompensationPush {
    uint32_t first, count;
    uint32_t ray, rays;
};

struct CompensationAimPush {
    uint32_t count;
    uint32_t seed;
    float radius;
};

struct HitPush {
    uint32_t count;
    float minDistanceSquared;
};

struct CompensationAddPush {
    uint32_t count;
    uint32_t rays;
    float radius;
};

}  // namespace

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
    plan.reserveScratch("compaction of rays that hit", Compaction::scratchBytes((batch + 31) / 32));
    plan.scratchBuffer(list_, "list of rays that hit", uint64_t(batch) * sizeof(uint32_t));
    plan.scratchBuffer(arriving_, "irradiance within the bound", uint64_t(batch) * 4 * sizeof(float));
}

void VplCompensation::prepare(PassSetup& setup) {
    const auto program = [&](const std::string& file) {
        return makeComputeProgram(setup.device, setup.compiler.compile("passes/gather_vpls/" + file));
    };
    begin_ = program("compensate_begin.comp");
    aim_ = program("compensate_aim.comp");
    flag_ = program("compensate_flag.comp");
    hit_ = program("compensate_hit.comp");
    add_ = program("compensate_add.comp");
    compaction_.emplace(setup.device, setup.compiler);
    sampler_ = texelSampler(setup.device);
    direct_.prepare(setup);
}

void VplCompensation::record(PassContext& context, const Vpls& vpls, const VplLight& light,
                             const VplLight::Visibility& visibility, const GBuffer& gbuffer,
                             const VplTarget& target) {
    CommandStream& stream = context.stream;
    const glm::uvec2 extent = gbufferExtent(context.frame, gbuffer.samples);
    const uint32_t texels = extent.x * extent.y, batch = uint32_t(hits_.bytes() / sizeof(Hit));
    for (uint32_t first = 0; first < texels; first += batch)
        for (uint32_t ray = 0; ray < settings_.rays; ++ray) {
            uint32_t count = std::min(texels - first, batch);
            stream.dispatch(begin_,
                            {{"position", gbuffer.position, sampler_},
                             {"normal", gbuffer.normal, sampler_},
                             {"geometricNormal", gbuffer.geometricNormal, sampler_},
                             {"surfels", from_.surfels},
                             {"faceNormals", from_.faceNormals}},
                            BeginCompensationPush{first, count, ray, settings_.rays}, linearGroups(count));

            // What surfels reflect, hit after hit: direct light, and virtual lights of all bounces but as
            // many last ones as there were hits.
            for (uint32_t reflections = 1; reflections <= settings_.bounces; ++reflections) {
                const uint32_t seed = randomSeed(context.frame, 0x71u + reflections);
                count = step(context, count, seed);
                if (count == 0) break;
                direct_.measure(context, sources_, from_.surfels, count, 1, seed + 0x35u, arriving_);
                light.addToSurfels(context, vpls, visibility, from_.surfels, from_.faceNormals, count,
                                   reflections, arriving_);
                stream.dispatch(
                    add_,
                    {{"surfels", from_.surfels},
                     {"arriving", arriving_},
                     {"irradiance", target.irradiance},
                     {"sums", target.sums}},
                    CompensationAddPush{count, settings_.rays, std::sqrt(settings_.minDistanceSquared)},
                    linearGroups(count));
            }
        }
}

uint32_t VplCompensation::step(PassContext& context, uint32_t count, uint32_t seed) {
    CommandStream& stream = context.stream;
    stream.dispatch(aim_,
                    context.scene.bindings(
                        {{"surfels", from_.surfels}, {"faceNormals", from_.faceNormals}, {"rays", rays_}}),
                    CompensationAimPush{count, seed, std::sqrt(settings_.minDistanceSquared)},
                    linearGroups(count));
    context.tracer.closestHit(stream, rays_, hits_, count);

    // Few rays hit: from here on there are only these.
    const uint32_t words = (count + 31) / 32;
    stream.dispatch(flag_, {{"hits", hits_}, {"flags", flags_}}, count, linearGroups(words));
    const uint32_t hits = compaction_->run(stream, flags_, list_, words);
    if (hits > 0)
        stream.dispatch(hit_,
                        context.scene.bindings({{"list", list_},
                                                {"hits", hits_},
                                                {"from", from_.surfels},
                                                {"surfels", to_.surfels},
                                                {"faceNormals", to_.faceNormals}}),
                        HitPush{hits, settings_.minDistanceSquared}, linearGroups(hits));
    std::swap(from_, to_);
    return hits;
}

}  // namespace voxray
