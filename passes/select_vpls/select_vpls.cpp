#include "passes/select_vpls/select_vpls.h"

#include <algorithm>
#include <glm/gtc/constants.hpp>

#include "passes/common/compute/dispatch.h"
#include "passes/common/compute/random_seed.h"
#include "passes/common/lights/light_sources.h"
#include "passes/common/view/frame_image.h"
#include "passes/select_vpls/resample.h"

namespace voxray {
namespace {

constexpr uint32_t kBatchShadowRays = 1u << 19;  // Bounds the memory of rays to 20 MiB.

struct AimPush {
    uint32_t first, count;
    uint32_t points;
    uint32_t seed;
    float minDistanceSquared;
};

struct ImportancePush {
    uint32_t first, count;
    uint32_t points;
};

}  // namespace

void SelectVpls::declare(PassBuilder& builder) {
    gbuffer_ = builder.read<GBuffer>("gbuffer", "what the camera sees");
    candidates_ = builder.read<Vpls>("vpls", "virtual point lights to choose from");
    vpls_ = builder.write<Vpls>("vpls", "those that stay");
}

void SelectVpls::plan(PassPlan& plan) {
    const Vpls& candidates = plan.get(candidates_);
    const uint64_t points = uint64_t(candidates.paths) * candidates.bounces;
    Vpls& vpls = plan.get(vpls_);
    vpls.bounces = candidates.bounces;
    vpls.lightBounces = candidates.lightBounces;
    vpls.paths = uint32_t(std::min<uint64_t>(params_.count, points));
    vpls.areaPerPath = float(surfaceArea(plan.frame.scene->geometry) * vpls.bounces / vpls.paths);
    plan.buffer(vpls.points, "selected virtual point lights", vpls.places(kName) * sizeof(gpu::Vpl));
    plan.buffer(vpls.list, "list of selected virtual point lights", vpls.paths * sizeof(uint32_t));
    plan.buffer(places_, "places of selected virtual point lights", vpls.paths * sizeof(uint32_t));
    plan.buffer(weights_, "weights of selected virtual point lights", vpls.paths * sizeof(float));
    const uint64_t batch = std::min(points, uint64_t(kBatchShadowRays / params_.points)),
                   rays = batch * params_.points;
    plan.scratchBuffer(rays_, "shadow rays", rays * sizeof(Ray));
    plan.scratchBuffer(carried_, "kernels of shadow rays", rays * sizeof(float));
    plan.scratchBuffer(occluded_, "shadow ray results", rays * sizeof(uint32_t));
    plan.scratchBuffer(importance_, "importance of virtual point lights", batch * sizeof(glm::vec2));
}

void SelectVpls::prepare(PassSetup& setup) {
    const auto program = [&](const std::string& file) {
        return makeComputeProgram(setup.device, setup.compiler.compile("passes/select_vpls/" + file));
    };
    aim_ = program("aim.comp");
    importanceProgram_ = program("importance.comp");
    scale_ = program("scale.comp");
    sampler_ = texelSampler(setup.device);
}

void SelectVpls::record(PassContext& context) {
    CommandStream& stream = context.stream;
    const Vpls& candidates = context.get(candidates_);
    Vpls& vpls = context.get(vpls_);
    if (candidates.count == 0) {  // Every light was switched off.
        vpls.count = 0;
        context.report("selected vpls", 0);
        return;
    }

    // Most go to lights by what they bring to the image, some by their flux.
    const std::vector<glm::vec2> found = importance(context);
    double irradiance = 0, flux = 0;
    for (const glm::vec2& light : found) {
        irradiance += light.x;
        flux += light.y;
    }
    const double byFlux = irradiance > 0 ? params_.unseen : 1;
    std::vector<double> probabilities;
    for (const glm::vec2& light : found)
        probabilities.push_back((irradiance > 0 ? (1 - byFlux) * light.x / irradiance : 0) +
                                byFlux * light.y / flux);
    const double offset = double(randomSeed(context.frame, 0x92u) >> 8) / (1 << 24);
    const Resampled kept = resample(probabilities, vpls.paths, offset);

    // Each becomes the only vertex of a path of its own, at the bounce that it had.
    const auto numbers = stream.readAs<uint32_t>(candidates.list, candidates.count);
    std::vector<uint32_t> list;
    for (const uint32_t place : kept.places)
        list.push_back(uint32_t(list.size()) * vpls.bounces + numbers[place] % vpls.bounces);
    stream.fill(vpls.points, 0);
    stream.upload(vpls.list, list);
    stream.upload(places_, kept.places);
    stream.upload(weights_, kept.weights);
    stream.dispatch(scale_,
                    {{"VplsAt", candidates.points.at()},
                     {"candidateList", candidates.list},
                     {"places", places_},
                     {"weights", weights_},
                     {"list", vpls.list},
                     {"SelectedAt", vpls.points.at()}},
                    uint32_t(list.size()), linearGroups(list.size()));
    vpls.count = uint32_t(list.size());
    context.report("selected vpls", vpls.count);
}

std::vector<glm::vec2> SelectVpls::importance(PassContext& context) const {
    CommandStream& stream = context.stream;
    const GBuffer& gbuffer = context.get(gbuffer_);
    const Vpls& candidates = context.get(candidates_);
    const uint32_t batch = uint32_t(occluded_.bytes() / sizeof(uint32_t)) / params_.points;
    const float minDistanceSquared =
        params_.bound * params_.bound * context.get(vpls_).areaPerPath / glm::pi<float>();
    std::vector<glm::vec2> all;
    for (uint32_t first = 0; first < candidates.count; first += batch) {
        const uint32_t count = std::min(candidates.count - first, batch), rays = count * params_.points;
        stream.dispatch(
            aim_,
            context.scene.bindings({{"position", gbuffer.position, sampler_},
                                    {"normal", gbuffer.normal, sampler_},
                                    {"geometricNormal", gbuffer.geometricNormal, sampler_},
                                    {"VplsAt", candidates.points.at()},
                                    {"list", candidates.list},
                                    {"rays", rays_},
                                    {"carried", carried_}}),
            AimPush{first, count, params_.points, randomSeed(context.frame, 0x91u), minDistanceSquared},
            linearGroups(rays));
        context.tracer.occluded(stream, rays_, occluded_, rays);
        stream.dispatch(importanceProgram_,
                        {{"VplsAt", candidates.points.at()},
                         {"list", candidates.list},
                         {"carried", carried_},
                         {"occluded", occluded_},
                         {"importance", importance_}},
                        ImportancePush{first, count, params_.points}, linearGroups(count));
        const auto found = stream.readAs<glm::vec2>(importance_, count);
        all.insert(all.end(), found.begin(), found.end());
    }
    return all;
}

}  // namespace voxray
