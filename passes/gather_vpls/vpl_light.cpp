#include "passes/gather_vpls/vpl_light.h"

#include <algorithm>

#include "passes/common/compute/dispatch.h"
#include "passes/common/compute/random_seed.h"
#include "passes/common/view/frame_image.h"
#include "shaders/hybrid_leaves/hybrid_types.h"

namespace voxray {
namespace {

constexpr uint32_t kBatchRays = 1u << 20;  // Bounds the memory of rays and what they carry to 52 MiB.

struct MeanPush {
    gpu::VplBatch batch;
    float minDistanceSquared;
};

struct AimPush {
    gpu::VplBatch batch;
    float minDistanceSquared;
    uint32_t seed;
    float dim;
    gpu::VoxelGrid grid;
    float endEpsilon;
};

struct ShadowsPush {
    gpu::VplBatch batch;
    uint32_t resolution;
};

struct AddPush {
    gpu::VplBatch batch;
};

}  // namespace

void VplLight::plan(PassPlan& plan, const Settings& settings, glm::uvec2 texels, uint64_t maxVpls) {
    settings_ = settings;
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

void VplLight::prepare(PassSetup& setup) {
    const auto programs = [&](Defines defines) {
        if (settings_.dim.below > 0)
            defines.emplace(settings_.dim.isByChance ? "ROULETTE" : "EARLY_OUT", "1");
        if (settings_.starts) defines.emplace("STARTS", "1");
        const auto program = [&](const std::string& file) {
            return makeComputeProgram(setup.device,
                                      setup.compiler.compile("passes/gather_vpls/" + file, defines));
        };
        Programs all;
        if (settings_.dim.below > 0) all.mean = program("mean.comp");
        all.aim = program("aim.comp");
        if (settings_.maps) {
            Defines withMaps = defines;
            withMaps.merge(settings_.maps->defines());
            all.shadows = makeComputeProgram(
                setup.device, setup.compiler.compile("passes/gather_vpls/map_shadows.comp", withMaps));
        }
        all.add = program("add.comp");
        return all;
    };
    texels_ = programs({});
    if (settings_.surfels) surfels_ = programs({{"SURFELS", "1"}});
    sampler_ = texelSampler(setup.device);
}

void VplLight::addToTexels(PassContext& context, const Vpls& vpls, const Visibility& visibility,
                           const GBuffer& gbuffer, const VplTarget& target) const {
    gpu::VplBatch batch{};
    batch.receivers = gbufferExtent(context.frame, gbuffer.samples);
    const glm::uvec2 extent = (batch.receivers + settings_.block - 1u) / settings_.block;
    add(context, vpls, visibility, batch, extent.x * extent.y, texels_,
        {{"position", gbuffer.position, sampler_},
         {"normal", gbuffer.normal, sampler_},
         {"geometricNormal", gbuffer.geometricNormal, sampler_}},
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
    std::vector<Binding> lights = receivers, adding = target;
    lights.insert(lights.end(), {{"VplsAt", vpls.points.at()}, {"list", vpls.list}});
    std::vector<Binding> shading = lights, aiming = context.scene.bindings(std::move(lights));
    std::vector<Binding> averaging = aiming;
    aiming.insert(aiming.end(), {{"rays", rays_}, {"carried", carried_}});
    if (settings_.starts) aiming.emplace_back("starts", starts_);
    if (settings_.dim.below > 0)
        for (std::vector<Binding>* bindings : {&averaging, &aiming}) bindings->emplace_back("means", means_);
    if (maps) shading.insert(shading.end(), {{"rays", rays_}, maps->binding(), {"occluded", occluded_}});
    adding.insert(adding.end(), {{"carried", carried_}, {"occluded", occluded_}});
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
                stream.dispatch(programs.mean, averaging, MeanPush{all, settings_.minDistanceSquared},
                                linearGroups(batch.count));
            }
            for (batch.firstVpl = begin; batch.firstVpl < end; batch.firstVpl += batch.vplCount) {
                batch.vplCount = std::min(end - batch.firstVpl, maxVpls);
                const uint32_t rays = batch.count * batch.vplCount;
                stream.dispatch(programs.aim, aiming,
                                AimPush{batch, settings_.minDistanceSquared, randomSeed(context.frame, 0xa1u),
                                        settings_.dim.below, visibility.grid, settings_.endEpsilon},
                                linearGroups(rays));
                if (maps) {
                    maps->draw(context, vpls, batch.firstVpl, batch.vplCount);
                    stream.dispatch(programs.shadows, shading, ShadowsPush{batch, maps->resolution()},
                                    linearGroups(rays));
                } else if (visibility.tracer) {
                    visibility.tracer->occluded(stream, rays_, occluded_, rays, Coherence::Coherent);
                }
                stream.dispatch(programs.add, adding, AddPush{batch}, linearGroups(batch.count));
            }
        }
    }
}

}  // namespace voxray
