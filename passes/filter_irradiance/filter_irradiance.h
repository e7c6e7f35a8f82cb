#pragma once

#include "passes/common/filter/noisy_irradiance.h"
#include "passes/common/view/frame_image.h"

namespace voxray {

/// Lowers the noise of any gather's irradiance. Source: the edge-avoiding à-trous wavelet of Dammertz et al.
/// 2010, with a weight that balances noise against what texels differ by: the gradient bound of Ward et al.
/// 1988, geometry, and the means of their surroundings (wavelet.comp).
/// Docs: docs/filtering.md.
class FilterIrradiance final : public Pass {
 public:
    static constexpr const char* kName = "filter_irradiance";
    static constexpr const char* kHelp =
        "Filters the noisy irradiance of a gather (gather_rays, path_trace) along surfaces and multiplies it "
        "by albedo. An edge-avoiding wavelet whose width follows from the number of rays and, where the "
        "gather tells them, from their variance, the distances of their hits, and how much the light around "
        "texels differs. Biased by: "
        "edge_stopping_scale and levels, less the more rays. Lambert surfaces only. Source: Dammertz et al. "
        "2010; Ward et al. 1988; docs/filtering.md.";
    struct Params {
        uint32_t levels = 4;
        float edgeStoppingScale = 0.1f;
        static constexpr auto schema() {
            return std::tuple{
                field("levels", &Params::levels,
                      "Levels of the wavelet, each of twice the reach of the one before: n levels reach "
                      "2^n - 1 pixels.",
                      1u, 6u),
                field("edge_stopping_scale", &Params::edgeStoppingScale,
                      "Factor of the bound on how much irradiance differs between two texels. 1: the whole "
                      "bound, sharp and noisy. Smaller: smoother, and shadows blur. Most changes cancel, so "
                      "a tenth is a good start.",
                      0.01f, 100.0f)};
        }
    };

    explicit FilterIrradiance(const Params& params) : params_(params) {}
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    void findLight(PassContext& context) const;
    const Image& means(PassContext& context) const;
    glm::uvec3 elementGroups() const;

    Params params_;
    Port<const GBuffer> gbuffer_;
    Port<const NoisyIrradiance> noisy_;
    Port<FrameImage> indirect_;
    Program findSurfaces_, statistics_, mean_, findLight_, wavelet_, resolve_;
    Sampler sampler_;
    Buffer second_;           ///< How many pixels show a second surface, then their numbers.
    Buffer blockStatistics_;  ///< gpu::RayStatistics a block, where the gather tells moments.
    // Images of elements (elements.glsl).
    Image surfaces_;     ///< surface.glsl
    Image reflectance_;  ///< Albedo times the part of the pixel that has it.
    Image means_[2];     ///< Of surroundings (mean.comp), where the gather tells moments.
    Image light_;        ///< surface_light.glsl
    Image filtered_[2];  ///< Irradiance, W/m², and number of rays; levels write them in turn.
};

}  // namespace voxray
