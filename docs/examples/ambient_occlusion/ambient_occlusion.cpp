#include <algorithm>

#include "graph/registry.h"
#include "passes/common/compute/random_seed.h"
#include "passes/common/view/gbuffer.h"

namespace voxray {

/// Indirect light as ambient occlusion: the same radiance from every unoccluded direction.
class AmbientOcclusion final : public Pass {
 public:
    static constexpr const char* kName = "ambient_occlusion";
    static constexpr const char* kHelp =
        "Indirect light from a constant: 'ambient' arrives from each direction in which a ray hits nothing\n"
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

    void plan(PassPlan& plan) override {
        raysPerPixel_ = plan[gbuffer_].samples * plan[gbuffer_].samples * params_.rays;
        const uint32_t pixels = plan.frame.width * plan.frame.height;
        batchPixels_ = std::clamp(kBatchRays / raysPerPixel_, 1u, pixels);
        const uint64_t rays = uint64_t(batchPixels_) * raysPerPixel_;
        plan.scratchBuffer(rays_, "ambient rays", rays * sizeof(Ray));
        plan.scratchBuffer(occluded_, "ambient rays' answers", rays * sizeof(uint32_t));
        plan.frameImage(indirect_);
    }

    void record(PassContext& context) override {
        const uint32_t width = context.frame.width, pixels = width * context.frame.height;
        for (uint32_t first = 0; first < pixels; first += batchPixels_) {
            const uint32_t count = std::min(batchPixels_, pixels - first), rays = count * raysPerPixel_;
            const Bindings batch{context[gbuffer_],
                                 {"rays", rays_},
                                 {"width", width},
                                 {"firstPixel", first},
                                 {"pixels", count},
                                 {"raysPerTexel", params_.rays},
                                 {"radius", params_.radius},
                                 {"seed", randomSeed(context.frame, context.frameIndex)},
                                 {"ambient", params_.ambient}};
            context.dispatch(generateRays_, rays, batch);
            context.tracer.occluded(context.stream, rays_, occluded_, rays);
            context.dispatch(average_, count,
                             {batch.all(), {"occluded", occluded_}, {"indirect", context[indirect_].image}});
        }
    }

 private:
    static constexpr uint32_t kBatchRays = 1u << 16;  ///< Bounds rays and answers to 2.3 MiB, whatever the image.

    const Params params_;
    In<GBuffer> gbuffer_{*this, "gbuffer", "what the camera sees"};
    Out<FrameImage> indirect_{*this, "indirect", "radiance reflected of ambient light"};
    Kernel generateRays_{*this, "generate_occlusion_rays.comp"};
    Kernel average_{*this, "average.comp"};
    uint32_t raysPerPixel_ = 0, batchPixels_ = 0;
    Buffer rays_, occluded_;  ///< Of a batch of pixels.
};
VOXRAY_REGISTER_PASS(AmbientOcclusion);

}  // namespace voxray
