#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "base/error.h"
#include "graph/registry.h"
#include "passes/common/compute/random_seed.h"
#include "passes/probes/update_probes/probe_lattice.h"
#include "passes/probes/update_probes/probe_light.h"
#include "passes/probes/update_probes/probe_placement.h"
#include "passes/probes/update_probes/update_probes_params.h"

namespace voxray {

/// Irradiance probes, filled by rays. Source: Majercik et al. 2019, "Dynamic diffuse global illumination with
/// ray-traced irradiance fields"; Majercik et al. 2021, "Scaling probe-based real-time dynamic global
/// illumination for production". Docs: docs/probes.md.
class UpdateProbes final : public Pass {
 public:
    static constexpr const char* kName = "update_probes";
    static constexpr const char* kHelp =
        "Fills a grid of irradiance probes (DDGI) by rays from them. "
        "Each probe holds irradiance by normal and moments of the distance of surfaces by direction. "
        "Hits are lit by shadow rays and the probes' own light, or by voxels. "
        "Biased by: the spacing of probes (what is smaller is lost, light leaks round thin walls), "
        "encoding_gamma, blend_gamma and wrap_weights; hysteresis, light that changed since. "
        "Noisy by: rays_per_probe, updates. Lambert surfaces only. "
        "Source: Majercik et al. 2019 and 2021; docs/probes.md.";
    using Params = UpdateProbesParams;

    explicit UpdateProbes(const Params& params) : params_(params) {}
    Phase phase() const override { return updatesEachFrame() ? Phase::Frame : Phase::Build; }
    bool buildReadsView() const override { return params_.cascades > 1; }
    uint32_t warmupFrames() const override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    bool updatesEachFrame() const { return params_.update == ProbeUpdate::EachFrame; }
    bool isLitByProbes() const { return params_.source == ProbeSource::Probes; }
    void planImages(PassPlan& plan);
    /// Moves cascades with the camera, and places probes where they or surfaces are new.
    void placeProbes(PassContext& context, const Probes& probes);
    /// One update of all probes that are on; the light of those that were not in the last frame is new.
    void updateFrame(PassContext& context, Probes& probes, uint32_t seed);
    /// Light of `bounces` bounces, or of one more than the voxels have.
    void build(PassContext& context, Probes& probes, uint32_t seed);
    /// Averages `updates` updates of a list of probes. @param hysteresis of the first, in each frame; in a build
    /// 0, and all weigh alike.
    void updateList(PassContext& context, Probes& probes, const std::vector<uint32_t>& list, uint32_t updates,
                    float hysteresis, uint32_t seed);

    const Params params_;
    Out<Probes> probes_{*this, "probes", "irradiance in a grid of points"};
    ProbeRays rays_{*this};
    ProbePlacement placement_{*this};
    ProbeLight light_{*this, params_.source};
    Kernel blendIrradiance_{*this, "blend_irradiance.comp"};
    Kernel blendDepth_{*this, "blend_depth.comp"};
    ProbeLattice lattice_;
    gpu::ProbeSettings settings_{};
    Image lastIrradiance_;  ///< Of the bounce or the frame before, which lights hits.
    Buffer irradianceHistory_, depthHistory_;
    uint64_t sceneVersion_ = 0;  ///< For which probes were placed.
    bool hasDepth_ = false;
    std::vector<bool> isLit_;  ///< By probe: whether its history is that of the last frame.
};

uint32_t UpdateProbes::warmupFrames() const {
    // Until the first frame weighs a hundredth
    if (!updatesEachFrame() || params_.hysteresis == 0) return 0;
    return uint32_t(std::ceil(std::log(0.01f) / std::log(params_.hysteresis)));
}

void UpdateProbes::plan(PassPlan& plan) {
    lattice_ =
        makeProbeLattice(plan.frame.scene->geometry.region, params_.probes, params_.cascades, params_.minDistance);
    settings_ = {.counts = lattice_.counts,
                 .cascades = params_.cascades,
                 .irradianceTexels = params_.irradianceTexels,
                 .depthTexels = params_.depthTexels,
                 .testsVisibility = params_.visibility,
                 .wrapsWeights = params_.wrapWeights,
                 .normalBias = params_.normalBias,
                 .viewBias = params_.viewBias,
                 .crushThreshold = params_.crushThreshold,
                 .encodingGamma = params_.encodingGamma,
                 .blendGamma = params_.blendGamma,
                 .unit = radianceUnit(*plan.frame.scene)};
    if (!isLitByProbes())
        plan[probes_].lightBounces = oneMoreBounce(light_.voxelBounces(plan));
    else if (!updatesEachFrame())
        plan[probes_].lightBounces = params_.bounces;

    planImages(plan);
    Probes& probes = plan[probes_];
    plan.buffer(probes.grids, "grids of probes",
                sizeof(gpu::ProbeSettings) + lattice_.grids.size() * sizeof(gpu::ProbeGrid));
    plan.buffer(probes.states, "states of probes", lattice_.size() * sizeof(gpu::ProbeState));
    const bool backsAreDark = params_.backfaces == ProbeBackfaces::Dark;
    rays_.plan(plan, params_.raysPerProbe, lattice_.size());
    placement_.plan({.relocationSteps = params_.relocationSteps,
                     .classifies = params_.classification,
                     .backfaceThreshold = params_.backfaceThreshold,
                     .minDistance = params_.minDistance,
                     .backsAreDark = backsAreDark});
    light_.plan(plan, rays_.batchRays(), params_.lightSamples, backsAreDark);
}

void UpdateProbes::planImages(PassPlan& plan) {
    Probes& probes = plan[probes_];
    const uint32_t largest = plan.device.filteredVolumeSide;
    if (largest == 0)
        throw Error(
            "{}: device '{}' can't store to and filter 3D images of half floats (R16G16B16A16_SFLOAT, "
            "storage image and linear filter)",
            kName, plan.device.name);
    // An image one texel deep would be 2D
    const auto extent = [&](uint32_t texels) {
        const glm::uvec3 counts = lattice_.counts;
        return glm::uvec3(counts.x * (texels + 2), counts.z * (texels + 2), std::max(counts.y * params_.cascades, 2u));
    };
    const glm::uvec3 depthExtent = extent(params_.depthTexels), irradianceExtent = extent(params_.irradianceTexels);
    const glm::uvec3 size = glm::max(depthExtent, irradianceExtent);
    if (std::max({size.x, size.y, size.z}) > largest)
        throw Error(
            "{}: the 3D image of all probes has {}x{}x{} texels, device '{}' takes at most {} along an axis "
            "(maxImageDimension3D); lower 'probes'",
            kName, size.x, size.y, size.z, plan.device.name, largest);

    const ImageDesc irradiance{VK_FORMAT_R16G16B16A16_SFLOAT, irradianceExtent};
    plan.image(probes.irradiance, "irradiance of probes", irradiance);
    if (isLitByProbes()) plan.image(lastIrradiance_, "last irradiance of probes", irradiance);
    plan.image(probes.depth, "depth moments of probes", {VK_FORMAT_R16G16_SFLOAT, depthExtent});

    const auto texels = [&](uint32_t side) { return uint64_t(lattice_.size()) * side * side; };
    const uint64_t irradianceBytes = texels(params_.irradianceTexels) * sizeof(glm::vec3);
    const uint64_t depthBytes = texels(params_.depthTexels) * sizeof(glm::vec2);
    if (updatesEachFrame()) {
        plan.buffer(irradianceHistory_, "history of irradiance", irradianceBytes);
        plan.buffer(depthHistory_, "history of depth moments", depthBytes);
    } else {
        plan.scratchBuffer(irradianceHistory_, "mean irradiance so far", irradianceBytes);
        plan.scratchBuffer(depthHistory_, "mean depth moments so far", depthBytes);
    }
}

void UpdateProbes::prepare(PassSetup& setup) {
    Probes& probes = setup[probes_];
    for (const Image* image : {&probes.irradiance, &probes.depth}) setup.stream.clear(*image, {});
    if (isLitByProbes()) setup.stream.clear(lastIrradiance_, {});
    probes.sampler = Sampler(setup.device, Filter::Linear, VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                             VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE);
    isLit_.clear();
}

void UpdateProbes::record(PassContext& context) {
    Probes& probes = context[probes_];
    placeProbes(context, probes);
    placement_.report(context);
    light_.update(context);
    const uint32_t seed = randomSeed(context.frame, context.frameIndex);
    if (updatesEachFrame())
        updateFrame(context, probes, seed);
    else
        build(context, probes, seed);
}

void UpdateProbes::updateFrame(PassContext& context, Probes& probes, uint32_t seed) {
    if (isLitByProbes()) std::swap(probes.irradiance, lastIrradiance_);
    std::vector<uint32_t> lit, unlit;
    for (const uint32_t probe : placement_.active()) (isLit_[probe] ? lit : unlit).push_back(probe);
    updateList(context, probes, unlit, 1, 0, seed);
    updateList(context, probes, lit, 1, params_.hysteresis, seed);
    isLit_.assign(lattice_.size(), false);
    for (const uint32_t probe : placement_.active()) isLit_[probe] = true;
}

void UpdateProbes::build(PassContext& context, Probes& probes, uint32_t seed) {
    const uint32_t stages = isLitByProbes() ? params_.bounces : 1;
    if (isLitByProbes()) context.stream.clear(probes.irradiance, {});
    for (uint32_t stage = 0; stage < stages; ++stage) {
        if (isLitByProbes()) std::swap(probes.irradiance, lastIrradiance_);
        updateList(context, probes, placement_.active(), params_.updates, 0, seed + stage * 0x9e3779b9u);
        hasDepth_ = true;
    }
}

void UpdateProbes::placeProbes(PassContext& context, const Probes& probes) {
    const Frame& frame = context.frame;
    const ProbeLattice before = lattice_;
    centerProbes(lattice_, frame.camera.position);
    context.stream.upload(probes.grids, std::as_bytes(std::span(&settings_, 1)));
    context.stream.upload(probes.grids, std::as_bytes(std::span(lattice_.grids)), sizeof(settings_));

    const bool onlyLightChanged = frame.changedRegions && frame.changedRegions->empty();
    const bool isFirst = isLit_.empty();
    std::vector<uint32_t> list = freshProbes(lattice_, before);
    if (isFirst) isLit_.resize(lattice_.size());
    for (const uint32_t probe : list) isLit_[probe] = false;
    if (isFirst || (frame.sceneVersion != sceneVersion_ && !onlyLightChanged)) {
        list.resize(lattice_.size());
        std::iota(list.begin(), list.end(), 0u);
    }
    sceneVersion_ = frame.sceneVersion;
    if (list.empty()) return;
    placement_.place(context, probes, rays_, list);
    hasDepth_ = false;
}

void UpdateProbes::updateList(PassContext& context, Probes& probes, const std::vector<uint32_t>& list, uint32_t updates,
                              float hysteresis, uint32_t seed) {
    if (list.empty()) return;
    std::vector<Binding> lookup = probes.bindings();
    if (isLitByProbes()) lookup.push_back({"probeIrradiance", lastIrradiance_, probes.sampler});
    const bool updatesDepth = updatesEachFrame() || !hasDepth_;
    const bool isFrame = updatesEachFrame();
    rays_.setList(context.stream, list);
    for (uint32_t u = 0; u < updates; ++u) {
        const uint32_t updateSeed = seed + 0x51u + u * 0x85ebca6bu;
        const float old = isFrame ? hysteresis : float(u) / float(u + 1);
        rays_.trace(context, probes, std::max(updateSeed, 1u), [&](const ProbeBatch& batch) {
            const Binding light = light_.shade(context, rays_, batch, lookup, updateSeed + 0xa3u);
            const Bindings blend{
                probes, rays_.bindings(), light, {"first", batch.first}, {"count", batch.count}, {"hysteresis", old}};
            const auto invocations = [&](uint32_t side) { return uint64_t(batch.count) * side * side; };
            context.dispatch(blendIrradiance_, invocations(params_.irradianceTexels),
                             {blend.all(),
                              {"irradianceHistory", irradianceHistory_},
                              {"irradiance", probes.irradiance},
                              {"changeThreshold", isFrame ? params_.changeThreshold : 1.0f},
                              {"resetThreshold", isFrame ? params_.resetThreshold : 1.0f}});
            if (updatesDepth)
                context.dispatch(blendDepth_, invocations(params_.depthTexels),
                                 {blend.all(),
                                  {"depthHistory", depthHistory_},
                                  {"depth", probes.depth},
                                  {"sharpness", params_.depthSharpness}});
        });
    }
}

VOXRAY_REGISTER_PASS(UpdateProbes);

}  // namespace voxray
