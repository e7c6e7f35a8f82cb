#include "graph/registry.h"
#include "passes/common/filter/irradiance_resolve.h"
#include "passes/common/filter/noisy_irradiance.h"
#include "passes/common/view/surface_motion.h"

namespace voxray {

/// Accumulates a gather's irradiance over frames. Source: the temporal accumulation of Schied et al. 2017
/// (SVGF), with the clamp of Salvi 2016. Docs: docs/accumulation.md.
class Accumulate final : public Pass {
 public:
    static constexpr const char* kName = "accumulate";
    static constexpr const char* kFilterLabel = "accumulated";
    static constexpr const char* kHelp =
        "Averages a gather's irradiance over frames by temporal reprojection. "
        "The history of a surface point is looked up at its image position in the previous frame. "
        "The result has less noise and is 'noisy_irradiance' of filter_irradiance, or an image. "
        "Biased where light changes, by lag, which 'clamp' bounds, and, while the camera moves, "
        "by the blur of lookups between texels. Source: Schied et al. 2017; Salvi 2016; docs/accumulation.md.";
    struct Params {
        uint32_t history = 16;
        float clamp = 0.0f;
        static constexpr auto schema() {
            return std::tuple{
                field("history", &Params::history,
                      "Maximum frames in the mean, this one included; beyond them the mean is exponential. "
                      "1: this frame only.",
                      1u, 64u),
                field("clamp", &Params::clamp,
                      "Maximum difference of history from the mean of this frame's neighborhood, "
                      "in standard deviations of the neighborhood: smaller for less lag and more noise. 0: unlimited.",
                      0.0f, 100.0f)};
        }
    };

    explicit Accumulate(const Params& params) : params_(params) {}
    uint32_t warmupFrames() const override { return params_.history - 1; }
    void plan(PassPlan& plan) override;
    void record(PassContext& context) override;

 private:
    const Params params_;
    In<GBuffer> gbuffer_{*this, "gbuffer", "what the camera sees"};
    In<SurfaceMotion> motion_{*this, "motion", "motion since the previous frame"};
    In<NoisyIrradiance> noisy_{*this, "noisy_irradiance", "irradiance of this frame"};
    Out<NoisyIrradiance> accumulated_{*this, "noisy_irradiance", "mean irradiance over frames"};
    Out<FrameImage> indirect_{*this, "indirect", "radiance reflected of this irradiance"};
    Kernel averageCells_{*this, "average_cells.comp"};
    Kernel accumulate_{*this, "accumulate.comp", params_.clamp > 0 ? Defines{{"CLAMP", "1"}} : Defines{}};
    Kernel storeHistory_{*this, "store_history.comp"};
    IrradianceResolve resolve_{*this};
    Image cellLight_, cellSurface_;  ///< average_cells.comp; where history is clamped.
    Image frames_;                   ///< R32F: length of the texel's history, this frame included.
    // Stored for the next frame
    bool hasHistory_ = false;
    Image historyLight_;     ///< RGBA32F: irradiance, W/m², and number of rays.
    Image historyPosition_;  ///< RGBA32F: m; instance as in SurfaceMotion::previous.
    Image historyNormal_;    ///< RGBA16F: geometric normal; frames.
};

void Accumulate::plan(PassPlan& plan) {
    const NoisyIrradiance& noisy = plan[noisy_];
    const uint32_t samples = plan[gbuffer_].samples;
    const glm::uvec2 texels = gbufferExtent(plan.frame, samples);
    const ImageDesc values{VK_FORMAT_R32G32B32A32_SFLOAT, {texels, 1}};

    plan[accumulated_].planAccumulated(plan, noisy, samples);
    FrameImage& indirect = plan[indirect_];
    indirect.lightBounces = noisy.lightBounces;
    if (indirect.isRead) plan.frameImage(indirect_);

    plan.image(frames_, "length of history", {VK_FORMAT_R32_SFLOAT, values.extent});
    plan.image(historyLight_, "history of irradiance", values);
    plan.image(historyPosition_, "history of positions", values);
    plan.image(historyNormal_, "history of normals", {VK_FORMAT_R16G16B16A16_SFLOAT, values.extent});
    averageCells_.compileIf(params_.clamp > 0);
    if (params_.clamp == 0) return;
    const ImageDesc cells{values.format, {(texels + noisy.spacing - 1u) / noisy.spacing, 1}};
    plan.image(cellLight_, "light of cells", cells);
    plan.image(cellSurface_, "surfaces of cells", cells);
}

void Accumulate::record(PassContext& context) {
    const GBuffer& gbuffer = context[gbuffer_];
    const SurfaceMotion& motion = context[motion_];
    const NoisyIrradiance& noisy = context[noisy_];
    const NoisyIrradiance& result = context[accumulated_];
    const glm::uvec3 texels = result.irradiance.desc().extent;

    // Average the cells of this frame's neighborhoods
    if (params_.clamp > 0)
        context.dispatch(averageCells_, cellLight_.desc().extent,
                         {gbuffer,
                          {"irradiance", noisy.irradiance},
                          {"previous", motion.previous},
                          {"cellLight", cellLight_},
                          {"cellSurface", cellSurface_},
                          {"spacing", noisy.spacing}});

    // Add this frame to the history
    context.dispatch(accumulate_, texels,
                     {gbuffer,
                      {"irradiance", noisy.irradiance},
                      {"motion", motion.motion},
                      {"previous", motion.previous},
                      ifUsed({"cellLight", cellLight_}),
                      ifUsed({"cellSurface", cellSurface_}),
                      {"historyLight", historyLight_},
                      {"historyPosition", historyPosition_},
                      {"historyNormal", historyNormal_},
                      {"result", result.irradiance},
                      {"frames", frames_},
                      {"history", float(params_.history)},
                      {"clamp", params_.clamp},
                      {"hasHistory", hasHistory_},
                      {"spacing", noisy.spacing}});

    // Store it for the next frame
    context.dispatch(storeHistory_, texels,
                     {gbuffer,
                      {"result", result.irradiance},
                      {"frames", frames_},
                      {"previous", motion.previous},
                      {"historyLight", historyLight_},
                      {"historyPosition", historyPosition_},
                      {"historyNormal", historyNormal_}});
    hasHistory_ = true;

    result.copyVariance(context.stream, noisy);
    if (const FrameImage& indirect = context[indirect_]; indirect.isRead)
        resolve_.record(context, gbuffer, result.irradiance, indirect.image);
}

VOXRAY_REGISTER_PASS(Accumulate);

}  // namespace voxray
