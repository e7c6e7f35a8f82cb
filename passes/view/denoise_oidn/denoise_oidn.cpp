#include <memory>
#include <string>

#include "base/error.h"
#include "graph/registry.h"
#include "passes/common/filter/noisy_irradiance.h"
#include "passes/view/denoise_oidn/open_image_denoise.h"

namespace voxray {

/// Denoises a gather's irradiance by Open Image Denoise: in place of filter_irradiance, the denoiser that users
/// of path tracers pick. Docs: docs/filtering.md.
class DenoiseOidn final : public Pass {
 public:
    static constexpr const char* kName = "denoise_oidn";
    static constexpr const char* kFilterLabel = "denoised by OIDN";
    static constexpr const char* kHelp =
        "Denoises a gather's irradiance by the learned filter of Open Image Denoise. "
        "It reads the pixels' noisy radiance, albedo and normals, and runs on the CPU. "
        "The library is not part of Voxray: it is loaded from 'library' when a config has this pass. "
        "Biased: it keeps neither energy nor linearity. Lambert surfaces only. "
        "Source: https://www.openimagedenoise.org.";
    struct Params {
        std::string library = "libOpenImageDenoise.so.2";
        static constexpr auto schema() {
            return std::tuple{field("library", &Params::library,
                                    "The library, version 2: a name that the dynamic loader finds, or a path.")};
        }
    };

    explicit DenoiseOidn(const Params& params) : params_(params) {}

    void plan(PassPlan& plan) override {
        const NoisyIrradiance& noisy = plan[noisy_];
        if (noisy.spacing > plan[gbuffer_].samples)
            throw Error(
                "denoise_oidn: the gather has rays for one texel in each {0}x{0}, so for fewer than each pixel; raise its "
                "rays, or use filter_irradiance",
                noisy.spacing);
        if (!library_) library_ = std::make_unique<OpenImageDenoise>(params_.library);
        plan[indirect_].lightBounces = noisy.lightBounces;
        plan.frameImage(indirect_);
        plan.buffer(inputs_, "noisy image", pixelsOf(plan.frame) * NoisyImage::kFloats * sizeof(float));
    }

    void record(PassContext& context) override {
        const glm::uvec2 pixels = context.frame.pixels();
        context.dispatch(
            findInputs_, pixels,
            {context[gbuffer_], {"irradiance", context[noisy_].irradiance}, {"noisy", inputs_}, {"pixels", pixels}});
        NoisyImage image{.width = pixels.x, .height = pixels.y, .pixels = {}};
        image.pixels = context.stream.readAs<float>(inputs_, pixelsOf(context.frame) * NoisyImage::kFloats);
        const std::vector<float> denoised = library_->denoise(image);
        context.stream.upload(context[indirect_].image, std::as_bytes(std::span(denoised)));
    }

 private:
    static uint64_t pixelsOf(const Frame& frame) { return uint64_t(frame.width) * frame.height; }

    const Params params_;
    In<GBuffer> gbuffer_{*this, "gbuffer", "what the camera sees"};
    In<NoisyIrradiance> noisy_{*this, "noisy_irradiance", "irradiance from few rays a texel"};
    Out<FrameImage> indirect_{*this, "indirect", "radiance reflected of this light"};
    Kernel findInputs_{*this, "inputs.comp"};
    Buffer inputs_;  ///< A NoisyImage's pixels.
    std::unique_ptr<OpenImageDenoise> library_;
};
VOXRAY_REGISTER_PASS(DenoiseOidn);

}  // namespace voxray
