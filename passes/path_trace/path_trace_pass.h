#pragma once

#include <array>
#include <memory>

#include "graph/reference_sums.h"
#include "passes/common/filter/noisy_irradiance.h"
#include "passes/path_trace/path_tracer.h"
#include "trace/embree_scene.h"

namespace voxray {

template <>
struct EnumNames<PathLight> {
    static constexpr std::array names{std::pair{PathLight::All, "all"},
                                      std::pair{PathLight::Indirect, "indirect"}};
};

/// The reference path tracer (path_tracer.h) as a pass: many samples make it the reference of all others, few
/// make it the baseline on the chart. It shares no shader and no stream with the methods that it is compared
/// with.
class PathTracePass final : public Pass {
 public:
    static constexpr const char* kName = "path_trace";
    static constexpr bool kNeedsDevice = false;
    static constexpr const char* kHelp =
        "Path tracer on the CPU (Embree): next-event estimation and multiple importance sampling, "
        "Owen-scrambled Sobol "
        "points. Unbiased for the bounces that it is given; noisy by: spp. Writes total and indirect light, "
        "each also as two independent halves, and irradiance at the g-buffer's texels for "
        "filter_irradiance.";
    struct Params {
        uint32_t spp = 64;
        uint32_t bounces = 8;
        PathLight light = PathLight::All;
        static constexpr auto schema() {
            return std::tuple{
                field("spp", &Params::spp, "Samples a pixel.", 1u, 1u << 20).lessNoise(),
                field(
                    "bounces", &Params::bounces,
                    "Scattering events after direct light at the first hit; 0 is emission and direct light.",
                    0u, 1024u),
                field("light", &Params::light,
                      "indirect: nothing is spent on emission and direct light at the first hit; another "
                      "pass writes 'final'.")};
        }
    };

    explicit PathTracePass(const Params& params) : params_(params) {}
    Phase phase() const override { return Phase::Frame; }
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    Params params_;
    /// An output and what is rendered for it; 'final' is the first.
    struct RenderedImage {
        Port<FrameImage> port;
        const char* name;
        PathLight light;  ///< Where paths are spent on this light alone, it is written.
        const ImageF& (*pixels)(const PathTraceResult&);
        bool isHalf;
    };
    /// With `light: indirect` nothing but indirect light is; of a single sample there are no halves.
    bool isRendered(const RenderedImage& image) const {
        return (image.light == PathLight::Indirect || params_.light == PathLight::All) &&
               (!image.isHalf || params_.spp > 1);
    }

    Port<const GBuffer> gbuffer_;
    std::vector<RenderedImage> images_;
    Port<NoisyIrradiance> noisy_;
    Port<ReferenceSums> sums_;
    PathTraceOptions options_;
    std::unique_ptr<EmbreeScene> embree_;
};

}  // namespace voxray
