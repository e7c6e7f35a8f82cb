#include <algorithm>
#include <array>
#include <optional>

#include "graph/registry.h"
#include "passes/common/compute/random_seed.h"
#include "passes/common/lights/light_sources.h"
#include "passes/common/lights/pane_transmittance.h"
#include "passes/common/view/gbuffer.h"
#include "passes/common/voxel_march/voxel_tracer.h"

namespace voxray {
namespace {

constexpr uint32_t kBatchRays = 1u << 20;  // Bounds the memory of rays and their radiance to 52 MiB.

/// Pixels of a batch.
uint32_t batchPixels(const Frame& frame, const GBuffer& gbuffer) {
    return std::min(frame.width * frame.height, kBatchRays / (gbuffer.samples * gbuffer.samples));
}

}  // namespace

/// Geometry for shadow rays: the scene's triangles, or its surface voxels.
enum class Visibility { Exact, Voxels };
template <>
struct EnumNames<Visibility> {
    static constexpr std::array names{std::pair{Visibility::Exact, "exact"}, std::pair{Visibility::Voxels, "voxels"}};
};

/// Direct light by shadow rays through the stream interface: from each texel of the G-buffer one ray to each
/// point, spot and directional light, and `light_samples` rays to emissive surfaces and to the environment.
class DirectShadowRays final : public Pass {
 public:
    static constexpr const char* kName = "direct_shadow_rays";
    static constexpr const char* kHelp =
        "Computes direct light by shadow rays from every pixel to every light. Exact for point, "
        "spot and directional lights; noisy by `light_samples` for emissive surfaces (picked by power, "
        "uniform over area) and for the environment (by cosine). "
        "Mirrors reflect no lamp and no environment: gather_mirror adds their reflections. "
        "With `visibility: voxels` biased by voxel size. Compare with gather_irradiance with `light: direct`.";
    struct Params {
        uint32_t lightSamples = 4;
        Visibility visibility = Visibility::Exact;
        static constexpr auto schema() {
            return std::tuple{
                field("light_samples", &Params::lightSamples,
                      "Shadow rays from each G-buffer texel to all emissive surfaces together, "
                      "and as many to the environment.",
                      1u, 4096u)
                    .lessNoise(),
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
    bool tracesVoxels() const { return params_.visibility == Visibility::Voxels; }

    const Params params_;
    In<GBuffer> gbuffer_{*this, "gbuffer", "what the camera sees"};
    In<SurfaceVoxels> voxels_{*this, "voxels", "geometry for shadow rays", tracesVoxels()};
    Out<FrameImage> direct_{*this, "direct", "radiance reflected of direct light"};
    Kernel generateRays_{*this, "generate_shadow_rays.comp"};
    Kernel add_{*this, "add_unoccluded.comp"};
    Buffer rays_, radiance_, occluded_;
    PaneTransmittance paneTransmittance_{*this};
    std::optional<VoxelTracer> voxelTracer_;  ///< With Visibility::Voxels.
};

void DirectShadowRays::plan(PassPlan& plan) {
    const GBuffer& gbuffer = plan[gbuffer_];
    const uint64_t rays = batchPixels(plan.frame, gbuffer) * gbuffer.samples * gbuffer.samples;
    plan.buffer(rays_, "shadow rays", rays * sizeof(Ray));
    plan.buffer(radiance_, "shadow ray radiance", rays * 4 * sizeof(float));
    plan.buffer(occluded_, "shadow ray results", rays * sizeof(uint32_t));
    paneTransmittance_.plan(plan, rays);
    plan.lightRays = uint64_t(plan.frame.width) * plan.frame.height * gbuffer.samples * gbuffer.samples *
                     plan.frame.scene->lights.size();
    plan.frameImage(direct_);
    if (tracesVoxels()) voxelTracer_.emplace(*this, VoxelTraversal::Bricks).plan(plan, plan[voxels_]);
    generateRays_.specialize({{"kTraceVoxels", tracesVoxels()}});
}

void DirectShadowRays::record(PassContext& context) {
    const GBuffer& gbuffer = context[gbuffer_];
    const Image& direct = context[direct_].image;
    CommandStream& stream = context.stream;
    const Frame& frame = context.frame;
    const uint32_t pixels = frame.width * frame.height;
    const uint32_t batch = batchPixels(frame, gbuffer), perPixel = gbuffer.samples * gbuffer.samples;
    const uint32_t seed = randomSeed(frame, context.frameIndex);
    stream.clear(direct, {});
    RayTracer* tracer = &context.tracer;
    gpu::VoxelGrid grid{};
    if (voxelTracer_) {
        const SurfaceVoxels& voxels = context[voxels_];
        grid = voxels.grid;
        voxelTracer_->begin(stream, voxels);
        tracer = &*voxelTracer_;
    }
    const uint64_t raysBefore = tracer->raysTraced();

    // A stream of shadow rays for each punctual light, `light` being its index, and for each sample of the
    // emissive surfaces and of the environment, `light` being the sample's index
    const auto shadowRays = [&](LightSource::Kind kind, uint32_t light) {
        for (uint32_t first = 0; first < pixels; first += batch) {
            const uint32_t count = std::min(batch, pixels - first), rays = count * perPixel;
            context.dispatch(generateRays_, rays,
                             {context.scene,
                              gbuffer,
                              {"rays", rays_},
                              {"rayRadiance", radiance_},
                              {"kind", kind},
                              {"light", light},
                              {"lightSamples", params_.lightSamples},
                              {"width", frame.width},
                              {"firstPixel", first},
                              {"batchRays", rays},
                              {"seed", seed},
                              {"emitterCount", context.scene.emitterCount},
                              {"camera", frame.camera.position},
                              {"grid", grid}});
            tracer->occluded(stream, rays_, occluded_, rays,
                             kind == LightSource::Punctual ? Coherence::Coherent : Coherence::Incoherent);
            paneTransmittance_.apply(context, rays_, radiance_, 4, rays);
            context.dispatch(add_, count,
                             {{"rayRadiance", radiance_},
                              {"occluded", occluded_},
                              {"direct", direct},
                              {"width", frame.width},
                              {"firstPixel", first},
                              {"batchPixels", count},
                              {"raysPerPixel", perPixel}});
        }
    };
    for (uint32_t light = 0; light < context.scene.lightCount; ++light) shadowRays(LightSource::Punctual, light);
    for (uint32_t s = 0; s < params_.lightSamples; ++s) {
        if (context.scene.emitterCount > 0) shadowRays(LightSource::Emitters, s);
        if (context.scene.hasEnvironment) shadowRays(LightSource::Environment, s);
    }
    if (voxelTracer_) {
        context.extraRays += tracer->raysTraced() - raysBefore;
        context.visitCounts.push_back(&voxelTracer_->march().counts());
    }
}

VOXRAY_REGISTER_PASS(DirectShadowRays);

}  // namespace voxray
