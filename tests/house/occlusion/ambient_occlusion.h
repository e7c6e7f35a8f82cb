#pragma once

#include <glm/vec3.hpp>
#include <tuple>

#include "passes/common/view/frame_image.h"
#include "passes/common/view/gbuffer.h"

namespace voxray {

/// Indirect light as ambient occlusion: the same radiance from every direction that nothing near stands in.
class AmbientOcclusion final : public Pass {
 public:
    static constexpr const char* kName = "ambient_occlusion";
    static constexpr const char* kHelp =
        "Indirect light out of a constant: 'ambient' arrives from each direction in which nothing is met\n"
        "within 'radius'.\n"
        "Biased: no light is carried from surface to surface. Noisy by: rays. Lambert surfaces only.\n"
        "Source: Zhukov et al. 1998.";
    struct Params {
        uint32_t rays = 16;
        float radius = 1;
        glm::vec3 ambient{1.0f};
        static constexpr auto schema() {
            return std::tuple{
                field("rays", &Params::rays, "Rays from each texel of the g-buffer.", 1u, 4096u).lessNoise(),
                field("radius", &Params::radius, "How far rays reach, m.", 1e-3f, 1e6f),
                field("ambient", &Params::ambient, "Radiance, W/(m² sr).", glm::vec3(0.0f), glm::vec3(1e6f))};
        }
    };

    explicit AmbientOcclusion(const Params& params) : params_(params) {}
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    uint32_t raysPerPixel(const GBuffer& gbuffer) const {
        return gbuffer.samples * gbuffer.samples * params_.rays;
    }
    uint32_t batchPixels(const Frame& frame, const GBuffer& gbuffer) const;

    Params params_;
    Port<const GBuffer> gbuffer_;
    Port<FrameImage> indirect_;
    Buffer rays_, occluded_;  ///< Of a batch of pixels.
    Program aim_, average_;
    Sampler sampler_;
};

}  // namespace voxray
