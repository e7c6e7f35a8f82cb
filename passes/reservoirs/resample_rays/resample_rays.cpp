#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "base/error.h"
#include "graph/registry.h"
#include "passes/common/compute/random_seed.h"
#include "passes/common/filter/irradiance_resolve.h"
#include "passes/common/filter/noisy_irradiance.h"
#include "passes/common/filter/wavelet_noise.h"
#include "passes/common/view/gather_hits.h"
#include "passes/common/view/gather_light.h"
#include "passes/common/view/surface_motion.h"
#include "passes/reservoirs/reservoir_types.h"
#include "scene/camera_rays.h"

namespace voxray {

/// Whose samples a receiver reuses.
enum class Reuse { Spatial, Spatiotemporal };
template <>
struct EnumNames<Reuse> {
    static constexpr std::array names{std::pair{Reuse::Spatial, "spatial"},
                                      std::pair{Reuse::Spatiotemporal, "spatiotemporal"}};
};

/// How candidates are weighted.
enum class BiasCorrection { Pairwise, None };
template <>
struct EnumNames<BiasCorrection> {
    static constexpr std::array names{std::pair{BiasCorrection::Pairwise, "pairwise"},
                                      std::pair{BiasCorrection::None, "none"}};
};

namespace {

constexpr float kMinRadius = 3;  ///< Pixels (Ouyang et al. 2021, section 5).

/// Number of independent values of equal variance that filter_irradiance averages by default where light is even: a
/// level's 3 x 3 kernel averages 256/36.
float filteredPixels() {
    constexpr float kKernel = 256.0f / 36;
    return kKernel * std::pow(kKernel / WAVELET_OVERLAP, float(WAVELET_LEVELS - 1));
}

}  // namespace

/// Reservoir resampling of gather rays. Source: Ouyang et al. 2021 (ReSTIR GI), with the pairwise weights of
/// Bitterli 2021 and Lin et al. 2022. Docs: docs/reservoirs.md.
class ResampleRays final : public Pass {
 public:
    static constexpr const char* kName = "resample_rays";
    static constexpr const char* kHelp =
        "Resamples gather rays: receivers reuse hits of their neighbors and of earlier frames. "
        "Stands after gather_rays; each ray's irradiance becomes that of one hit, chosen out of many by what it brings. "
        "Adds no bias with `bias_correction: pairwise` where light and surfaces stand still; lags where they move. "
        "Noisy by: neighbors, m_max. Noise is correlated within search_radius. Lambert surfaces only. "
        "Source: Ouyang et al. 2021 (ReSTIR GI); Bitterli 2021; Lin et al. 2022; docs/reservoirs.md.";
    struct Params {
        Reuse reuse = Reuse::Spatial;
        BiasCorrection biasCorrection = BiasCorrection::Pairwise;
        uint32_t neighbors = 3;
        float searchRadius = 0.1f;
        uint32_t mMax = 30;
        float normalThreshold = 25;
        float depthThreshold = 0.05f;
        static constexpr auto schema() {
            return std::tuple{
                field("reuse", &Params::reuse,
                      "spatial: hits of neighbors in the same frame. spatiotemporal: also those of earlier frames, "
                      "where the receiver was seen then."),
                field("bias_correction", &Params::biasCorrection,
                      "pairwise: multiple importance sampling, with rays that test which receivers see a hit; "
                      "unbiased. none: weights by the number of candidates, and one visibility ray for the chosen hit, "
                      "like the paper's biased variant: faster, and dark where neighbors see less."),
                field("neighbors", &Params::neighbors,
                      "Places where a neighbor is looked for; those that are unlike the receiver are left out. "
                      "The paper has 9 where reservoirs hold few candidates, else 3.",
                      1u, 32u)
                    .lessNoise(),
                field("search_radius", &Params::searchRadius,
                      "Radius in which neighbors are drawn, over the image's height. "
                      "It is halved after each that is unlike the receiver, down to 3 pixels.",
                      0.0f, 1.0f),
                field("m_max", &Params::mMax, "Most candidates that the reservoir of earlier frames counts as.", 1u,
                      500u)
                    .onlyWith(oneOf(&Params::reuse, {Reuse::Spatiotemporal}))
                    .lessNoise(),
                field("normal_threshold", &Params::normalThreshold,
                      "Largest angle between the normals of receivers that share hits, degrees.", 0.0f, 180.0f),
                field("depth_threshold", &Params::depthThreshold,
                      "Largest difference of their distances to the camera, relative to the receiver's own; between "
                      "frames the largest distance of the two points.",
                      0.0f, 1000.0f)};
        }
    };

    explicit ResampleRays(const Params& params) : params_(params) {}
    uint32_t warmupFrames() const override { return isTemporal() ? params_.mMax : 0; }
    void plan(PassPlan& plan) override;
    void record(PassContext& context) override;

 private:
    bool isTemporal() const { return params_.reuse == Reuse::Spatiotemporal; }
    bool isUnbiased() const { return params_.biasCorrection == BiasCorrection::Pairwise; }
    Defines defines() const;
    float minCosine() const { return std::cos(params_.normalThreshold * std::numbers::pi_v<float> / 180); }
    /// Rays of a batch, and the first of them in the frame.
    struct Batch {
        uint32_t index, firstBlock, blocks, firstRay, rays;
    };
    static Batch batch(const GatherHits& hits, uint32_t index);
    void makeReservoirs(PassContext& context, const Batch& batch);
    void loadChangedRegions(PassContext& context);
    void reuseHistory(PassContext& context, const Batch& batch);
    void reuseNeighbors(PassContext& context, const Batch& batch);
    void average(PassContext& context, const Batch& batch);

    const Params params_;
    In<GBuffer> gbuffer_{*this, "gbuffer", "what the camera sees"};
    In<GatherHits> hits_{*this, "gather_hits", "where the gather rays hit"};
    In<GatherLight> light_{*this, "gather_light", "what they bring"};
    In<NoisyIrradiance> noisy_{*this, "noisy_irradiance", "for the variance of a single ray"};
    In<SurfaceMotion> motion_{*this, "motion", "motion since the previous frame", isTemporal()};
    Out<NoisyIrradiance> resampled_{*this, "noisy_irradiance", "irradiance of resampled rays"};
    Out<FrameImage> indirect_{*this, "indirect", "radiance reflected of this irradiance"};
    Kernel initial_{*this, "initial.comp", defines()};
    Kernel temporalRays_{*this, "temporal_rays.comp", defines()};
    Kernel temporalMerge_{*this, "temporal_merge.comp", defines()};
    Kernel spatialRays_{*this, "spatial_rays.comp", defines()};
    Kernel spatialMerge_{*this, "spatial_merge.comp", defines()};
    Kernel effectiveRays_{*this, "effective_rays.comp"};
    Kernel average_{*this, "average.comp"};
    std::optional<IrradianceResolve> resolve_;  ///< Where `indirect` is read.
    // Of all gather rays: this frame's, and the previous one's. They change places.
    std::array<Buffer, 2> receivers_, reservoirs_;
    uint32_t current_ = 0;
    std::optional<uint64_t> historyScene_;  ///< Version of the scene in the previous frame; none: no history.
    LargeBuffer previousPositions_;         ///< Of vertices in that frame, m.
    Buffer changedRegions_;                 ///< Old and new box of each instance that has moved since.
    uint32_t changedCount_ = 0;             ///< Number of boxes.
    // Of a batch.
    Buffer neighborOf_, rays_, occluded_, values_, effective_;
};

Defines ResampleRays::defines() const {
    Defines defines;
    if (isTemporal()) defines.emplace("TEMPORAL", "1");
    if (isUnbiased()) defines.emplace("UNBIASED", "1");
    return defines;
}

void ResampleRays::plan(PassPlan& plan) {
    const GatherHits& hits = plan[hits_];
    const NoisyIrradiance& noisy = plan[noisy_];
    NoisyIrradiance& result = plan[resampled_];
    result.lightBounces = plan[indirect_].lightBounces = noisy.lightBounces;
    result.spacing = noisy.spacing;
    result.blockSize = noisy.blockSize;
    plan.image(result.irradiance, "resampled irradiance", NoisyIrradiance::desc(plan.frame, plan[gbuffer_].samples));
    if (noisy.blockSize > 0) plan.buffer(result.moments, "moments of rays", noisy.momentsBytes(hits.layout.texels));
    if (plan[indirect_].isRead) {
        if (noisy.spacing > 1)
            throw Error(
                "{}: some texels have no ray; let filter_irradiance follow, or raise 'rays_per_block' of "
                "trace_gather_rays",
                kName);
        plan.frameImage(indirect_);
        resolve_.emplace(*this);
    }

    const uint64_t rays = uint64_t(hits.blocks()) * hits.layout.raysPerBlock;
    for (uint32_t frame = 0; frame < (isTemporal() ? 2 : 1); ++frame) {
        plan.buffer(receivers_[frame], "receivers", rays * sizeof(gpu::Receiver));
        plan.buffer(reservoirs_[frame], "reservoirs", rays * sizeof(gpu::Reservoir));
    }
    if (isTemporal()) {
        const Geometry& geometry = plan.frame.scene->geometry;
        plan.buffer(previousPositions_, "previous vertices", geometry.positions.size() * sizeof(glm::vec3));
        plan.buffer(changedRegions_, "changed regions", 2 * geometry.instances.size() * sizeof(Box));
    }
    temporalRays_.compileIf(isTemporal());
    temporalMerge_.compileIf(isTemporal());

    const uint64_t batchRays = uint64_t(hits.blocksPerBatch) * hits.layout.raysPerBlock;
    const uint64_t tested = batchRays * (isUnbiased() ? std::max(params_.neighbors, 2u) : 1);
    plan.scratchBuffer(neighborOf_, "neighbors", batchRays * params_.neighbors * sizeof(uint32_t));
    plan.scratchBuffer(rays_, "visibility rays", tested * sizeof(Ray));
    plan.scratchBuffer(occluded_, "visibility rays' answers", tested * sizeof(uint32_t));
    plan.scratchBuffer(values_, "resampled rays", batchRays * sizeof(glm::vec4));
    plan.scratchBuffer(effective_, "effective numbers of rays", hits.blocksPerBatch * sizeof(float));
}

ResampleRays::Batch ResampleRays::batch(const GatherHits& hits, uint32_t index) {
    const uint32_t first = index * hits.blocksPerBatch, blocks = hits.batchBlocks(index);
    return {index, first, blocks, first * hits.layout.raysPerBlock, blocks * hits.layout.raysPerBlock};
}

void ResampleRays::record(PassContext& context) {
    const GatherHits& hits = context[hits_];
    const auto forBatches = [&](void (ResampleRays::*step)(PassContext&, const Batch&)) {
        for (uint32_t b = 0; b < hits.batches.size(); ++b) (this->*step)(context, batch(hits, b));
    };
    forBatches(&ResampleRays::makeReservoirs);
    if (isTemporal()) {
        loadChangedRegions(context);
        forBatches(&ResampleRays::reuseHistory);
    }
    forBatches(&ResampleRays::reuseNeighbors);
    if (isTemporal()) {
        current_ = 1 - current_;
        if (historyScene_ != context.frame.sceneVersion)
            context.stream.copy(context.scene.positions, previousPositions_, previousPositions_.bytes());
        historyScene_ = context.frame.sceneVersion;
    }

    // Copy the moments of single rays, which resampling does not change
    const NoisyIrradiance &noisy = context[noisy_], &result = context[resampled_];
    if (noisy.blockSize > 0) context.stream.copy(noisy.moments, result.moments, result.moments.bytes());
    if (resolve_) resolve_->record(context, context[gbuffer_], result.irradiance, context[indirect_].image);
}

void ResampleRays::makeReservoirs(PassContext& context, const Batch& batch) {
    const CameraRays camera = cameraRays(context.frame.camera, context.frame.width, context.frame.height);
    const GatherHits& hits = context[hits_];
    Bindings bindings{context.scene,
                      context[gbuffer_],
                      {"hits", hits.batches[batch.index]},
                      {"light", context[light_].light[batch.index]},
                      {"nearDistances", context[light_].nearDistances[batch.index]},
                      {"receivers", receivers_[current_]},
                      {"reservoirs", reservoirs_[current_]},
                      {"layout", hits.layout},
                      {"firstBlock", batch.firstBlock},
                      {"rays", batch.rays},
                      {"camera", camera.origin}};
    context.dispatch(initial_, batch.rays,
                     isTemporal() ? Bindings{bindings.all(), {"previous", context[motion_].previous}} : bindings);
}

void ResampleRays::loadChangedRegions(PassContext& context) {
    const Frame& frame = context.frame;
    changedCount_ = 0;
    if (!historyScene_ || *historyScene_ == frame.sceneVersion) return;
    std::vector<Box> boxes{
        {glm::vec3(std::numeric_limits<float>::lowest()), glm::vec3(std::numeric_limits<float>::max())}};
    if (*historyScene_ + 1 == frame.sceneVersion && frame.changedRegions) boxes = *frame.changedRegions;
    changedCount_ = uint32_t(boxes.size());
    if (!boxes.empty()) context.stream.upload(changedRegions_, boxes);
}

void ResampleRays::reuseHistory(PassContext& context, const Batch& batch) {
    const uint32_t before = 1 - current_;
    const Bindings common{context.scene,
                          {"receivers", receivers_[current_]},
                          ifUsed({"reservoirs", reservoirs_[current_]}),
                          ifUsed({"previousReceivers", receivers_[before]}),
                          ifUsed({"previousReservoirs", reservoirs_[before]}),
                          ifUsed({"PreviousPositionsRef", previousPositions_.ref()}),
                          {"neighbors", neighborOf_},
                          ifUsed({"hasMoved", historyScene_ != context.frame.sceneVersion}),
                          ifUsed({"changedBoxes", changedRegions_}),
                          ifUsed({"position", context[gbuffer_].position}),
                          ifUsed({"previous", context[motion_].previous}),
                          ifUsed({"layout", context[hits_].layout}),
                          {"firstRay", batch.firstRay},
                          {"count", batch.rays}};
    context.dispatch(temporalRays_, batch.rays,
                     {common.all(),
                      ifUsed({"rays", rays_}),
                      {"motion", context[motion_].motion},
                      {"hasHistory", historyScene_.has_value()},
                      {"minCosine", minCosine()},
                      {"depthThreshold", params_.depthThreshold}});
    if (isUnbiased()) context.tracer.occluded(context.stream, rays_, occluded_, 2 * batch.rays);
    context.dispatch(temporalMerge_, batch.rays,
                     {common.all(),
                      ifUsed({"occluded", occluded_}),
                      {"seed", context[hits_].layout.seed},
                      ifUsed({"changedRegions", changedCount_}),
                      {"mMax", float(params_.mMax)}});
}

void ResampleRays::reuseNeighbors(PassContext& context, const Batch& batch) {
    const auto samples = float(context[gbuffer_].samples);
    const Bindings common{{"receivers", receivers_[current_]},  ifUsed({"reservoirs", reservoirs_[current_]}),
                          {"neighbors", neighborOf_},           ifUsed({"rays", rays_}),
                          {"firstRay", batch.firstRay},         {"count", batch.rays},
                          {"seed", context[hits_].layout.seed}, {"neighborCount", params_.neighbors}};
    context.dispatch(spatialRays_, batch.rays,
                     {common.all(),
                      {"layout", context[hits_].layout},
                      {"radius", params_.searchRadius * float(context.frame.height) * samples},
                      {"minRadius", kMinRadius * samples},
                      {"minCosine", minCosine()},
                      {"depthThreshold", params_.depthThreshold}});
    if (isUnbiased()) context.tracer.occluded(context.stream, rays_, occluded_, batch.rays * params_.neighbors);
    context.dispatch(spatialMerge_, batch.rays,
                     {common.all(), ifUsed({"occluded", occluded_}), {"resampled", values_}});
    context.tracer.occluded(context.stream, rays_, occluded_, batch.rays);
    average(context, batch);
}

void ResampleRays::average(PassContext& context, const Batch& batch) {
    const GatherHits& hits = context[hits_];
    const float radius = std::max(params_.searchRadius * float(context.frame.height), kMinRadius);
    const float reused = std::numbers::pi_v<float> * radius * radius, filtered = filteredPixels();
    context.dispatch(effectiveRays_, batch.blocks,
                     {{"reservoirs", reservoirs_[current_]},
                      {"resampled", values_},
                      {"occluded", occluded_},
                      {"effectiveRays", effective_},
                      {"firstRay", batch.firstRay},
                      {"blocks", batch.blocks},
                      {"raysPerBlock", hits.layout.raysPerBlock},
                      {"shared", filtered / (reused + filtered)}});
    context.dispatch(average_, uint64_t(batch.blocks) * hits.layout.blockSize * hits.layout.blockSize,
                     {{"resampled", values_},
                      {"occluded", occluded_},
                      {"effectiveRays", effective_},
                      {"result", context[resampled_].irradiance},
                      {"layout", hits.layout},
                      {"firstBlock", batch.firstBlock},
                      {"batchBlocks", batch.blocks}});
}

VOXRAY_REGISTER_PASS(ResampleRays);

}  // namespace voxray
