#pragma once

#include "passes/common/filter/irradiance_resolve.h"
#include "passes/common/filter/noisy_irradiance.h"
#include "passes/common/view/surface_motion.h"

namespace voxray {

/// Adds up a gather's irradiance over frames. Source: the temporal part of Schied et al. 2017 (SVGF), with
/// the clamp of Salvi 2016. Docs: docs/accumulation.md.
class Accumulate final : public Pass {
 public:
    static constexpr const char* kName = "accumulate";
    static constexpr const char* kHelp =
        "The mean of a gather's irradiance over frames: what a surface had in the frame before is looked up "
        "where it was seen then. Lowers noise; the result serves as 'noisy_irradiance' of filter_irradiance, "
        "or "
        "as an image. Biased where light changes, by lag, which 'clamp' bounds, and, while the camera moves, "
        "by "
        "the blur of lookups between texels. Source: Schied et al. 2017; Salvi 2016; docs/accumulation.md.";
    struct Params {
        uint32_t history = 16;
        float clamp = 0.0f;
        static constexpr auto schema() {
            return std::tuple{
                field("history", &Params::history,
                      "Frames in the mean, this one included. Once so many have come, each new one counts as "
                      "one "
                      "in so many. 1: this frame alone.",
                      1u, 64u),
                field("clamp", &Params::clamp,
                      "How far history may be off the mean of this frame's surroundings, in standard "
                      "deviations "
                      "of what these surroundings hold. 0: as far as it is. Smaller: less lag, more noise.",
                      0.0f, 100.0f)};
        }
    };

    explicit Accumulate(const Params& params) : params_(params) {}
    uint32_t framesBefore() const override { return params_.history - 1; }
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    Params params_;
    Port<const GBuffer> gbuffer_;
    Port<const SurfaceMotion> motion_;
    Port<const NoisyIrradiance> noisy_;
    Port<NoisyIrradiance> accumulated_;
    Port<FrameImage> indirect_;
    Program findCells_, accumulate_, keep_;
    IrradianceResolve resolve_;
    Sampler sampler_;
    Image cellLight_, cellSurface_;  ///< cells.comp; where history is clamped.
    Image frames_;  ///< R32F: in how many frames the texel's surface was seen, this one included.
    // Of the frame before
    bool hasHistory_ = false;
    Image historyLight_;     ///< RGBA32F: irradiance, W/m², and number of rays.
    Image historyPosition_;  ///< RGBA32F: m; instance as in SurfaceMotion::previous.
    Image historyNormal_;    ///< RGBA16F: geometric normal; frames.
};

}  // namespace voxray
