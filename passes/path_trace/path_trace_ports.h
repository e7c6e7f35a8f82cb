#pragma once

#include <array>
#include <cstdint>
#include <utility>

#include "graph/reference_sums.h"
#include "graph/registry.h"
#include "passes/common/filter/noisy_irradiance.h"
#include "passes/path_trace/path_tracer.h"

namespace voxray {

template <>
struct EnumNames<PathLight> {
    static constexpr std::array names{std::pair{PathLight::All, "all"}, std::pair{PathLight::Indirect, "indirect"}};
};

template <>
struct EnumNames<StratifiedOver> {
    static constexpr std::array names{std::pair{StratifiedOver::Pixel, "pixel"},
                                      std::pair{StratifiedOver::Neighbors, "neighbors"}};
};

/// Parameters of path tracing, on the host and on the device.
struct PathTraceParams {
    uint32_t spp = 64;
    uint32_t bounces = 8;
    PathLight light = PathLight::All;
    StratifiedOver stratifiedOver = StratifiedOver::Pixel;
    static constexpr auto schema() {
        return std::tuple{
            field("spp", &PathTraceParams::spp, "Samples a pixel.", 1u, 1u << 20).lessNoise(),
            field("bounces", &PathTraceParams::bounces,
                  "Scattering events after direct light at the first hit; 0 is emission and direct light.", 0u, 1024u),
            field("light", &PathTraceParams::light,
                  "all: all light. "
                  "indirect: no emission and direct light at the first hit; another pass writes 'final'."),
            field("stratified_over", &PathTraceParams::stratifiedOver,
                  "pixel: each pixel has points of its own, and noise that neighbors do not share. "
                  "neighbors: the samples of neighbors complement each other, so that a filter takes off more noise.")};
    }
};

/// What path tracing reads and writes, on the host and on the device.
class PathTracePorts : public Pass {
 public:
    explicit PathTracePorts(const PathTraceParams& params) : params_(params) {}
    Phase phase() const override { return Phase::Frame; }

 protected:
    struct RenderedImage {
        Out<FrameImage> port;
        PathLight light;
        int half = -1;  ///< 0 or 1: of one half of the samples.
    };
    /// Only indirect images with `light: indirect`; no halves of a single sample.
    bool isRendered(const RenderedImage& image) const {
        return (image.light == PathLight::Indirect || params_.light == PathLight::All) &&
               (image.half < 0 || params_.spp > 1);
    }

    /// Describes the outputs that are read. @param pass name in messages
    /// @throws Error if 'final' is read with `light: indirect`.
    void planOutputs(PassPlan& plan, const char* pass);

    const PathTraceParams params_;
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
    PathTraceOptions options_;  ///< From planOutputs() on.
};

}  // namespace voxray
