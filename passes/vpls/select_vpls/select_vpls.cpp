#include <algorithm>
#include <glm/gtc/constants.hpp>
#include <vector>

#include "graph/registry.h"
#include "passes/common/compute/random_seed.h"
#include "passes/common/view/gbuffer.h"
#include "passes/vpls/select_vpls/systematic_resampling.h"
#include "passes/vpls/vpls.h"
#include "scene/region_split.h"

namespace voxray {

/// Importance resampling of virtual point lights by their irradiance at a few random texels of the image.
/// Source: Georgiev and Slusallek 2010, "Simple and Robust Iterative Importance Sampling of Virtual Point
/// Lights".
class SelectVpls final : public Pass {
 public:
    static constexpr const char* kName = "select_vpls";
    static constexpr const char* kHelp =
        "Selects virtual point lights (VPLs) of sample_vpls by their light at random texels. "
        "The probability to select one is in proportion to its irradiance at a few texels, by exact shadow rays, "
        "and its flux is divided by that probability. No bias. Noisy by: count; "
        "and points, which miss virtual lights that few texels see. Source: Georgiev and Slusallek 2010.";
    struct Params {
        uint32_t count = 2048;
        uint32_t points = 32;
        float unseen = 0.1f;
        float bound = 1;
        static constexpr auto schema() {
            return std::tuple{
                field("count", &Params::count, "Maximum number of selected virtual lights.", 1u, 1u << 20).lessNoise(),
                field("points", &Params::points, "Random texels that each virtual light is tested at.", 1u, 1024u)
                    .lessNoise(),
                field("unseen", &Params::unseen,
                      "Fraction of 'count' that is selected by flux alone, "
                      "for virtual lights that the tested texels don't see. "
                      "A smaller one makes these rarer and brighter.",
                      0.001f, 1.0f),
                field("bound", &Params::bound,
                      "The 'bound' of gather_vpls, "
                      "so that virtual lights near the tested texels get the weight that they have there. "
                      "Another value is no bias.",
                      0.0f, 1000.0f)};
        }
    };

    explicit SelectVpls(const Params& params) : params_(params) {}
    void plan(PassPlan& plan) override;
    void record(PassContext& context) override;

 private:
    /// Luminance of each candidate's mean irradiance at texels, W/m², and of its flux, W.
    std::vector<glm::vec2> estimateImportance(PassContext& context) const;

    static constexpr uint32_t kBatchShadowRays = 1u << 19;  ///< Bounds the memory of rays to 20 MiB.

    const Params params_;
    In<GBuffer> gbuffer_{*this, "gbuffer", "what the camera sees"};
    In<Vpls> candidates_{*this, "vpls", "virtual point lights to select from"};
    Out<Vpls> vpls_{*this, "vpls", "selected virtual point lights"};
    Kernel generateRays_{*this, "generate_shadow_rays.comp"};
    Kernel estimateImportance_{*this, "estimate_importance.comp"};
    Kernel storeSelected_{*this, "store_selected.comp"};
    Buffer rays_, geometryTerms_, occluded_, importance_, selectedCandidates_, weights_;
};

void SelectVpls::plan(PassPlan& plan) {
    const Vpls& candidates = plan[candidates_];
    const uint64_t points = uint64_t(candidates.paths) * candidates.bounces;
    Vpls& vpls = plan[vpls_];
    vpls.bounces = candidates.bounces;
    vpls.lightBounces = candidates.lightBounces;
    vpls.paths = uint32_t(std::min<uint64_t>(params_.count, points));
    vpls.areaPerPath = float(surfaceArea(plan.frame.scene->geometry) * vpls.bounces / vpls.paths);
    plan.buffer(vpls.points, "selected virtual point lights", vpls.capacity(kName) * sizeof(gpu::Vpl));
    plan.buffer(vpls.activeIndices, "list of selected virtual point lights", vpls.paths * sizeof(uint32_t));
    plan.buffer(selectedCandidates_, "indices of selected virtual point lights", vpls.paths * sizeof(uint32_t));
    plan.buffer(weights_, "weights of selected virtual point lights", vpls.paths * sizeof(float));
    const uint64_t batch = std::min(points, uint64_t(kBatchShadowRays / params_.points)), rays = batch * params_.points;
    plan.scratchBuffer(rays_, "shadow rays", rays * sizeof(Ray));
    plan.scratchBuffer(geometryTerms_, "geometry terms of shadow rays", rays * sizeof(float));
    plan.scratchBuffer(occluded_, "shadow ray results", rays * sizeof(uint32_t));
    plan.scratchBuffer(importance_, "importance of virtual point lights", batch * sizeof(glm::vec2));
}

void SelectVpls::record(PassContext& context) {
    CommandStream& stream = context.stream;
    const Vpls& candidates = context[candidates_];
    Vpls& vpls = context[vpls_];
    if (candidates.activeCount == 0) {  // Every light was switched off.
        vpls.activeCount = 0;
        context.report("selected vpls", 0);
        return;
    }

    // A mixture: mostly by irradiance, partly by flux
    const std::vector<glm::vec2> importance = estimateImportance(context);
    double irradiance = 0, flux = 0;
    for (const glm::vec2& light : importance) {
        irradiance += light.x;
        flux += light.y;
    }
    const double fluxFraction = irradiance > 0 ? params_.unseen : 1;
    std::vector<double> probabilities;
    for (const glm::vec2& light : importance)
        probabilities.push_back((irradiance > 0 ? (1 - fluxFraction) * light.x / irradiance : 0) +
                                fluxFraction * light.y / flux);
    const double offset = double(randomSeed(context.frame, 0x92u) >> 8) / (1 << 24);
    const Resampled selected = systematicResampling(probabilities, vpls.paths, offset);

    // Each becomes the only vertex of its own path, at the bounce that it had
    const auto candidateIndices = stream.readAs<uint32_t>(candidates.activeIndices, candidates.activeCount);
    std::vector<uint32_t> activeIndices;
    for (const uint32_t i : selected.indices)
        activeIndices.push_back(uint32_t(activeIndices.size()) * vpls.bounces + candidateIndices[i] % vpls.bounces);
    stream.fill(vpls.points, 0);
    stream.upload(vpls.activeIndices, activeIndices);
    stream.upload(selectedCandidates_, selected.indices);
    stream.upload(weights_, selected.weights);
    stream.dispatch(storeSelected_, activeIndices.size(),
                    {{"VplsRef", candidates.points.ref()},
                     {"candidateIndices", candidates.activeIndices},
                     {"selectedCandidates", selectedCandidates_},
                     {"weights", weights_},
                     {"activeVpls", vpls.activeIndices},
                     {"SelectedRef", vpls.points.ref()},
                     {"count", uint32_t(activeIndices.size())}});
    vpls.activeCount = uint32_t(activeIndices.size());
    context.report("selected vpls", vpls.activeCount);
}

std::vector<glm::vec2> SelectVpls::estimateImportance(PassContext& context) const {
    CommandStream& stream = context.stream;
    const Vpls& candidates = context[candidates_];
    const uint32_t batch = uint32_t(occluded_.bytes() / sizeof(uint32_t)) / params_.points;
    const float minDistanceSquared = params_.bound * params_.bound * context[vpls_].areaPerPath / glm::pi<float>();
    std::vector<glm::vec2> result;
    for (uint32_t first = 0; first < candidates.activeCount; first += batch) {
        const uint32_t count = std::min(candidates.activeCount - first, batch), rays = count * params_.points;
        context.dispatch(generateRays_, rays,
                         {context.scene,
                          context[gbuffer_],
                          {"VplsRef", candidates.points.ref()},
                          {"activeVpls", candidates.activeIndices},
                          {"rays", rays_},
                          {"geometryTerms", geometryTerms_},
                          {"first", first},
                          {"count", count},
                          {"texelsPerVpl", params_.points},
                          {"seed", randomSeed(context.frame, 0x91u)},
                          {"minDistanceSquared", minDistanceSquared}});
        context.tracer.occluded(stream, rays_, occluded_, rays);
        context.dispatch(estimateImportance_, count,
                         {{"VplsRef", candidates.points.ref()},
                          {"activeVpls", candidates.activeIndices},
                          {"geometryTerms", geometryTerms_},
                          {"occluded", occluded_},
                          {"importance", importance_},
                          {"first", first},
                          {"count", count},
                          {"texelsPerVpl", params_.points}});
        const auto importance = stream.readAs<glm::vec2>(importance_, count);
        result.insert(result.end(), importance.begin(), importance.end());
    }
    return result;
}

VOXRAY_REGISTER_PASS(SelectVpls);

}  // namespace voxray
