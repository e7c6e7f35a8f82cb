#include <array>
#include <memory>
#include <optional>
#include <utility>

#include "base/error.h"
#include "graph/reference_sums.h"
#include "graph/registry.h"
#include "passes/common/filter/noisy_irradiance.h"
#include "passes/path_trace/integrator.h"
#include "passes/path_trace/path_tracer.h"
#include "trace/embree_scene.h"

namespace voxray {
namespace {

/// Uploads an image of 3 or 4 channels; a missing fourth one is 1.
void upload(CommandStream& stream, const ImageF& source, const Image& target) {
    std::vector<float> rgba(source.pixelCount() * 4, 1.0f);
    for (size_t i = 0; i < source.pixelCount(); ++i)
        for (size_t c = 0; c < source.channels; ++c) rgba[4 * i + c] = source.data[source.channels * i + c];
    stream.upload(target, std::as_bytes(std::span(rgba)));
    stream.finish();
}

}  // namespace

template <>
struct EnumNames<PathLight> {
    static constexpr std::array names{std::pair{PathLight::All, "all"}, std::pair{PathLight::Indirect, "indirect"}};
};

/// The reference path tracer (path_tracer.h) as a pass: with many samples the reference of all methods, with
/// few a baseline. It shares no shader and no ray stream with the methods that it is compared with.
class PathTracePass final : public Pass {
 public:
    static constexpr const char* kName = "path_trace";
    static constexpr bool kNeedsDevice = false;
    static constexpr const char* kHelp =
        "Computes light by path tracing on the CPU with Embree. "
        "It uses next-event estimation, multiple importance sampling and Owen-scrambled Sobol points. "
        "Unbiased for its number of bounces; noisy by: spp. Writes total and indirect light, "
        "each also as two independent halves, and irradiance at the G-buffer's texels for filter_irradiance.";
    struct Params {
        uint32_t spp = 64;
        uint32_t bounces = 8;
        PathLight light = PathLight::All;
        static constexpr auto schema() {
            return std::tuple{
                field("spp", &Params::spp, "Samples a pixel.", 1u, 1u << 20).lessNoise(),
                field("bounces", &Params::bounces,
                      "Scattering events after direct light at the first hit; 0 is emission and direct light.", 0u,
                      1024u),
                field("light", &Params::light,
                      "all: all light. "
                      "indirect: no emission and direct light at the first hit; another pass writes 'final'.")};
        }
    };

    explicit PathTracePass(const Params& params) : params_(params) {}
    Phase phase() const override { return Phase::Frame; }
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    struct RenderedImage {
        Out<FrameImage> port;
        PathLight light;
        int half = -1;  ///< 0 or 1: of one half of the samples.

        const ImageF& pixels(const PathTraceResult& result) const {
            const bool isTotal = light == PathLight::All;
            if (half < 0) return isTotal ? result.total : result.indirect;
            return (isTotal ? result.totalHalves : result.indirectHalves)[size_t(half)];
        }
    };
    /// Only indirect images with `light: indirect`; no halves of a single sample.
    bool isRendered(const RenderedImage& image) const {
        return (image.light == PathLight::Indirect || params_.light == PathLight::All) &&
               (image.half < 0 || params_.spp > 1);
    }

    const Params params_;
    InOptional<GBuffer> gbuffer_{*this, "gbuffer", "whose texels 'noisy_irradiance' has; without it pixels"};
    /// The first is 'final'.
    const RenderedImage images_[6] = {
        {{*this, "final", "radiance towards the camera"}, PathLight::All},
        {{*this, "indirect", "its fraction that was scattered more than once"}, PathLight::Indirect},
        {{*this, "final_a", "'final' of one half of the samples"}, PathLight::All, 0},
        {{*this, "final_b", "'final' of the other half, independent of the first"}, PathLight::All, 1},
        {{*this, "indirect_a", "'indirect' of one half of the samples"}, PathLight::Indirect, 0},
        {{*this, "indirect_b", "'indirect' of the other half"}, PathLight::Indirect, 1}};
    Out<NoisyIrradiance> noisy_{*this, "noisy_irradiance",
                                "irradiance of indirect light, before the first hit reflects it"};
    Out<ReferenceSums> sums_{*this, "sums", "sums over the samples of each half, for references"};
    PathTraceOptions options_;
    std::unique_ptr<EmbreeScene> embree_;
    std::optional<path_trace::Integrator> integrator_;
    uint64_t sceneVersion_ = 0;  ///< Of the scene that the integrator was made for.
};

void PathTracePass::plan(PassPlan& plan) {
    if (params_.light == PathLight::Indirect && plan[images_[0].port].isRead)
        throw Error("path_trace: with 'light: indirect' it writes no 'final'; let composite follow");
    options_ = {.width = plan.frame.width,
                .height = plan.frame.height,
                .spp = params_.spp,
                .bounces = params_.bounces,
                .light = params_.light,
                .keepSums = plan[sums_].isRead && params_.light == PathLight::All && params_.spp > 1};
    for (const RenderedImage& image : images_) {
        FrameImage& frame = plan[image.port];
        frame.lightBounces = params_.bounces;
        frame.hasSpecularLobes = true;
        if (frame.isRead && isRendered(image)) plan.frameImage(image.port);
    }
    if (NoisyIrradiance& noisy = plan[noisy_]; noisy.isRead) {
        const uint32_t texels = plan[gbuffer_] ? plan[gbuffer_]->samples : 1;
        options_.irradianceTexels = texels;
        noisy.lightBounces = params_.bounces;
        noisy.spacing = texels;
        noisy.blockSize = texels * options_.momentsPixels();
        plan.image(noisy.irradiance, "path traced irradiance", NoisyIrradiance::desc(plan.frame, texels));
        plan.buffer(noisy.moments, "moments of paths", noisy.momentsBytes(gbufferExtent(plan.frame, texels)));
    }
}

void PathTracePass::prepare(PassSetup& setup) {
    embree_ = std::make_unique<EmbreeScene>(*setup.frame.scene);
}

void PathTracePass::record(PassContext& context) {
    const Frame& frame = context.frame;
    options_.seed = frame.seed + context.frameIndex;
    options_.samples = frame.samples;
    context.stream.finish();
    if (frame.changedRegions && !frame.changedRegions->empty()) embree_->update();
    if (!integrator_ || sceneVersion_ != frame.sceneVersion) {
        integrator_.emplace(*frame.scene, *embree_, options_.bounces, path_trace::Strategy::Mis, options_.light);
        sceneVersion_ = frame.sceneVersion;
    }
    PathTraceResult result = path_trace::render(*integrator_, frame.camera, options_, frame.progress);
    context.extraRays = result.rays;
    for (const RenderedImage& image : images_)
        if (const FrameImage& target = context[image.port]; target.isRead && isRendered(image))
            upload(context.stream, image.pixels(result), target.image);
    if (const NoisyIrradiance& noisy = context[noisy_]; noisy.isRead) {
        upload(context.stream, result.irradiance, noisy.irradiance);
        context.stream.upload(noisy.moments, result.moments);
    }
    ReferenceSums& sums = context[sums_];
    sums.final = std::move(result.totalSums);
    sums.indirect = std::move(result.indirectSums);
}

VOXRAY_REGISTER_PASS(PathTracePass);

}  // namespace voxray
