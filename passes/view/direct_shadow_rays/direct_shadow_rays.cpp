#include <algorithm>
#include <array>
#include <optional>

#include "graph/registry.h"
#include "passes/common/compute/random_seed.h"
#include "passes/common/filter/noisy_irradiance.h"
#include "passes/common/lights/light_sources.h"
#include "passes/common/lights/pane_transmittance.h"
#include "passes/common/view/gbuffer.h"
#include "passes/common/voxel_march/voxel_tracer.h"
#include "passes/view/direct_shadow_rays/shadow_ray_light.h"
#include "passes/view/direct_shadow_rays/shadow_ray_moments.h"
#include "scene/camera_rays.h"
#include "shaders/lights/light_sampling_types.h"

namespace voxray {
namespace {

constexpr uint32_t kBatchRays = 1u << 20;  // Bounds the memory of rays and their light to 68 MiB.
constexpr uint32_t kMaxRaysPerTexel = 2;   // Traced at once: to emissive surfaces and to the environment.
constexpr uint32_t kMinGroupRays = 4;      // From which variance is estimated (sum_moments.comp).

}  // namespace

/// Geometry for shadow rays: the scene's triangles, or its surface voxels.
enum class Visibility { Exact, Voxels };
template <>
struct EnumNames<Visibility> {
    static constexpr std::array names{std::pair{Visibility::Exact, "exact"}, std::pair{Visibility::Voxels, "voxels"}};
};

/// Direct light by shadow rays through the stream interface: from each texel of the G-buffer one ray to each
/// point, spot and directional light, and `light_samples` rays to emissive surfaces and to the environment. Many point
/// and spot lights are sampled with the emissive surfaces.
class DirectShadowRays final : public Pass {
 public:
    static constexpr const char* kName = "direct_shadow_rays";
    static constexpr const char* kHelp =
        "Computes direct light by shadow rays from every pixel. Exact for directional lights, and for up to "
        "`exact_lights` point and spot lights; noisy by `light_samples` for more of these, "
        "for emissive surfaces and for the environment. "
        "Each of these samples is selected from `candidates` by what the surface would reflect of it. "
        "filter_irradiance with `light: direct` denoises it. "
        "Mirrors reflect no lamp and no environment: gather_mirror adds their reflections. "
        "With `visibility: voxels` biased by voxel size. Compare with gather_irradiance with `light: direct`. "
        "Source: Talbot et al. 2005; many lights: Conty Estevez and Kulla 2018.";
    struct Params {
        uint32_t lightSamples = 4;
        uint32_t candidates = 4;
        uint32_t exactLights = kExactLights;
        Visibility visibility = Visibility::Exact;
        static constexpr auto schema() {
            return std::tuple{
                field("light_samples", &Params::lightSamples,
                      "Shadow rays from each G-buffer texel to all emissive surfaces together, "
                      "with the point and spot lights where these are more than `exact_lights`, "
                      "and as many to the environment.",
                      1u, 4096u)
                    .lessNoise(),
                field("candidates", &Params::candidates,
                      "Candidates from which a shadow ray is selected: emissive triangles, if there are no more "
                      "(otherwise the light tree picks one), "
                      "directions by the environment map's radiance and by cosine. "
                      "1: no selection, and the environment by cosine alone.",
                      1u, uint32_t(MAX_LIGHT_CANDIDATES)),
                field("exact_lights", &Params::exactLights,
                      "Up to so many point and spot lights each has its own ray from each texel, without noise; "
                      "if there are more, they are sampled. Its cost grows with the lights, that of samples hardly.",
                      0u, 1u << 20),
                field("visibility", &Params::visibility,
                      "Geometry for shadow rays. exact: the scene's triangles. voxels: "
                      "surface voxels, without those around the ray's origin; shadows are wider by about a voxel, "
                      "contacts and corners too dark or too bright within three (Magalhães 2020, section 3.3.3.2).")};
        }
    };

    explicit DirectShadowRays(const Params& params) : params_(params) {}
    void plan(PassPlan& plan) override;
    void record(PassContext& context) override;

 private:
    /// Rays of a texel that are traced at once, to one source each.
    struct Sample {
        LightSource::Kind kind;  ///< Of the first ray; a second one goes to the environment.
        uint32_t light;          ///< Index of the punctual light; of other sources that of the sample.
        uint32_t raysPerTexel;
    };

    bool tracesVoxels() const { return params_.visibility == Visibility::Voxels; }
    /// Whether what filter_irradiance may denoise is written, too.
    bool isSplit(const PortAccess& access) const { return access[noisy_].isRead || access[unfiltered_].isRead; }
    void clearOutputs(PassContext& context);
    void trace(PassContext& context, RayTracer& tracer, const gpu::VoxelGrid& grid, const Sample& sample);

    const Params params_;
    In<GBuffer> gbuffer_{*this, "gbuffer", "what the camera sees"};
    In<SurfaceVoxels> voxels_{*this, "voxels", "geometry for shadow rays", tracesVoxels()};
    Out<FrameImage> direct_{*this, "direct", "radiance reflected of direct light"};
    Out<NoisyIrradiance> noisy_{*this, "noisy_direct", "irradiance of lights that are sampled, for filter_irradiance"};
    Out<FrameImage> unfiltered_{*this, "unfiltered_direct",
                                "the part of 'direct' that 'noisy_direct' lacks: lights with own rays, specular lobes"};
    Kernel generateRays_{*this, "generate_shadow_rays.comp"};
    Kernel reflect_{*this, "reflect_unoccluded.comp"};
    Kernel reflectSampled_{*this, "reflect_unoccluded.comp", {{"SPLIT", "1"}, {"HITS", "1"}}};
    Kernel sumMoments_{*this, "sum_moments.comp"};
    Kernel statistics_{*this, "statistics.comp"};
    Buffer rays_, light_, occluded_;
    Buffer hits_;             ///< Where shadow rays are split, in place of `occluded_`.
    Image texelMoments_;      ///< reflect_unoccluded.comp
    Buffer moments_;          ///< gpu::ShadowRayMoments of blocks of 2 x 2 groups.
    uint32_t groupSize_ = 1;  ///< Texels along an edge of a group, which has kMinGroupRays or more.
    PaneTransmittance paneTransmittance_{*this};
    std::vector<LightSource> sources_;
    std::optional<VoxelTracer> voxelTracer_;  ///< With Visibility::Voxels.
};

void DirectShadowRays::plan(PassPlan& plan) {
    const GBuffer& gbuffer = plan[gbuffer_];
    const uint32_t texels = gbuffer.samples * gbuffer.samples;
    const uint64_t pixels = uint64_t(plan.frame.width) * plan.frame.height;
    const uint64_t rays = std::min<uint64_t>(pixels * texels * kMaxRaysPerTexel, kBatchRays);
    plan.buffer(rays_, "shadow rays", rays * sizeof(Ray));
    plan.buffer(light_, "shadow ray light", rays * sizeof(gpu::ShadowRayLight));
    plan.buffer(occluded_, "shadow ray results", rays * sizeof(uint32_t));
    paneTransmittance_.plan(plan, rays);
    sources_ = shadowRaySources(lightSources(*plan.frame.scene), *plan.frame.scene, params_.exactLights);
    const auto punctual = std::ranges::count(sources_, LightSource::Punctual, &LightSource::kind);
    plan.lightRays = pixels * texels * uint64_t(punctual);
    plan.frameImage(direct_);
    if (isSplit(plan)) {
        NoisyIrradiance& noisy = plan[noisy_];
        const ImageDesc texelsDesc = NoisyIrradiance::desc(plan.frame, gbuffer.samples);
        while (groupSize_ * groupSize_ * params_.lightSamples < kMinGroupRays) ++groupSize_;
        noisy.blockSize = 2 * groupSize_;
        noisy.hasStatistics = true;
        const glm::uvec2 blocks = noisy.blocks(gbufferExtent(plan.frame, gbuffer.samples));
        plan.image(noisy.irradiance, "noisy direct irradiance", texelsDesc);
        plan.buffer(noisy.statistics, "statistics of shadow rays",
                    noisy.statisticsBytes(gbufferExtent(plan.frame, gbuffer.samples)));
        plan.buffer(moments_, "moments of shadow rays", uint64_t(blocks.x) * blocks.y * sizeof(gpu::ShadowRayMoments));
        plan.image(texelMoments_, "moments of texels", texelsDesc);
        plan.frameImage(unfiltered_);
        plan.buffer(hits_, "shadow ray hits", rays * sizeof(Hit));
        reflect_.define({{"SPLIT", "1"}});
    }
    reflectSampled_.compileIf(isSplit(plan));
    sumMoments_.compileIf(isSplit(plan));
    statistics_.compileIf(isSplit(plan));
    if (tracesVoxels()) voxelTracer_.emplace(*this, VoxelTraversal::Bricks).plan(plan, plan[voxels_]);
    generateRays_.specialize({{"kTraceVoxels", tracesVoxels()}});
}

void DirectShadowRays::record(PassContext& context) {
    RayTracer* tracer = &context.tracer;
    gpu::VoxelGrid grid{};
    if (voxelTracer_) {
        const SurfaceVoxels& voxels = context[voxels_];
        grid = voxels.grid;
        voxelTracer_->begin(context.stream, voxels);
        tracer = &*voxelTracer_;
    }
    const uint64_t raysBefore = tracer->raysTraced();

    // Trace rays to each punctual light, then samples of the other sources
    clearOutputs(context);
    std::vector<LightSource::Kind> sampled;  // Emitters or the tree, then the environment.
    for (const LightSource& source : sources_) {
        if (source.kind == LightSource::Punctual)
            trace(context, *tracer, grid, {LightSource::Punctual, source.light, 1});
        else
            sampled.push_back(source.kind);
    }
    const auto count = uint32_t(sampled.size());
    for (uint32_t s = 0; s < params_.lightSamples && count > 0; ++s)
        trace(context, *tracer, grid, {sampled[0], s, count});

    if (isSplit(context)) {
        const NoisyIrradiance& noisy = context[noisy_];
        const glm::uvec2 blocks = noisy.blocks(glm::uvec2(noisy.irradiance.desc().extent));
        context.dispatch(sumMoments_, blocks,
                         {{"irradiance", noisy.irradiance},
                          {"texelMoments", texelMoments_},
                          {"moments", moments_},
                          {"blocks", blocks},
                          {"groupSize", groupSize_}});
        context.dispatch(statistics_, blocks,
                         {{"moments", moments_}, {"statistics", noisy.statistics}, {"blocks", blocks}});
    }
    if (voxelTracer_) {
        context.extraRays += tracer->raysTraced() - raysBefore;
        context.marchCounters.push_back(&voxelTracer_->march().counts());
    }
}

void DirectShadowRays::clearOutputs(PassContext& context) {
    context.stream.clear(context[direct_].image, {});
    if (!isSplit(context)) return;
    context.stream.clear(context[unfiltered_].image, {});
    context.stream.clear(context[noisy_].irradiance, {});
    context.stream.clear(texelMoments_, {});
}

void DirectShadowRays::trace(PassContext& context, RayTracer& tracer, const gpu::VoxelGrid& grid,
                             const Sample& sample) {
    const GBuffer& gbuffer = context[gbuffer_];
    const Frame& frame = context.frame;
    CommandStream& stream = context.stream;
    const uint32_t pixels = frame.width * frame.height;
    const uint32_t raysPerPixel = gbuffer.samples * gbuffer.samples * sample.raysPerTexel;
    const uint32_t batch = std::min(pixels, kBatchRays / raysPerPixel);
    const CameraRays camera = cameraRays(frame.camera, frame.width, frame.height);
    const bool hits = isSplit(context) && sample.kind != LightSource::Punctual;
    for (uint32_t first = 0; first < pixels; first += batch) {
        const uint32_t count = std::min(batch, pixels - first), rays = count * raysPerPixel;
        const Bindings common{gbuffer,
                              {"rays", rays_},
                              {"rayLight", light_},
                              {"raysPerTexel", sample.raysPerTexel},
                              {"lightSamples", params_.lightSamples},
                              {"width", frame.width},
                              {"firstPixel", first},
                              {"camera", frame.camera.position}};
        context.dispatch(generateRays_, rays,
                         {common.all(),
                          context.scene,
                          {"kind", sample.kind},
                          {"light", sample.light},
                          {"candidates", params_.candidates},
                          {"batchRays", rays},
                          {"seed", randomSeed(frame, context.frameIndex)},
                          {"emitterCount", context.scene.emitterCount},
                          {"emitterRoot", context.scene.emitterRoot},
                          {"grid", grid}});
        const Coherence coherence = sample.kind == LightSource::Punctual ? Coherence::Coherent : Coherence::Incoherent;
        if (hits)
            tracer.closestHit(stream, rays_, hits_, rays, coherence);
        else
            tracer.occluded(stream, rays_, occluded_, rays, coherence);
        paneTransmittance_.apply(context, rays_, light_, sizeof(gpu::ShadowRayLight) / sizeof(float), rays);
        context.dispatch(hits ? reflectSampled_ : reflect_, count,
                         {common.all(),
                          ifUsed({"occluded", occluded_}),
                          ifUsed({"hits", hits_}),
                          {"direct", context[direct_].image},
                          ifUsed({"unfiltered", context[unfiltered_].image}),
                          ifUsed({"irradiance", context[noisy_].irradiance}),
                          ifUsed({"texelMoments", texelMoments_}),
                          {"pixelAngle", 2 * glm::length(camera.up) / float(frame.height)},
                          {"batchPixels", count}});
    }
}

VOXRAY_REGISTER_PASS(DirectShadowRays);

}  // namespace voxray
