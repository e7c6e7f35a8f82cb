#pragma once

#include "passes/common/lights/pane_tint.h"
#include "passes/common/view/gbuffer.h"
#include "passes/common/voxel_march/voxel_tracer.h"

namespace voxray {

/// What shadow rays meet: the scene's triangles, or its surface voxels.
enum class Visibility { Exact, Voxels };
template <>
struct EnumNames<Visibility> {
    static constexpr std::array names{std::pair{Visibility::Exact, "exact"},
                                      std::pair{Visibility::Voxels, "voxels"}};
};

/// Direct light per pixel by shadow rays through the stream interface: one ray for each texel of the g-buffer
/// to each point, spot and directional light, `light_samples` rays to the emissive surfaces and to the
/// environment.
class DirectShadowRays final : public Pass {
 public:
    static constexpr const char* kName = "direct_shadow_rays";
    static constexpr const char* kHelp =
        "Direct light by shadow rays from every pixel to every light. Exact for point, spot and directional "
        "lights; noisy by "
        "`light_samples` for emissive surfaces (picked by power, uniform over area) and for the environment "
        "(by "
        "cosine). Mirrors reflect no lamp and no environment: gather_mirror brings what they show of these. "
        "With "
        "`visibility: voxels` biased by voxel size. Compare with direct_voxels.";
    struct Params {
        uint32_t lightSamples = 4;
        Visibility visibility = Visibility::Exact;
        static constexpr auto schema() {
            return std::tuple{
                field("light_samples", &Params::lightSamples,
                      "Shadow rays for each g-buffer texel to all emissive surfaces together, and as many to "
                      "the "
                      "environment.",
                      1u, 4096u)
                    .lessNoise(),
                field("visibility", &Params::visibility,
                      "What shadow rays meet. exact: the scene's triangles. voxels: those of the port "
                      "`voxels`, "
                      "those of their own surface left out; shadows are wider by about a voxel, contacts and "
                      "corners too dark or too bright within three (Magalhães 2020, section 3.3.3.2).")};
        }
    };

    explicit DirectShadowRays(const Params& params) : params_(params) {}
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    Params params_;
    Port<const GBuffer> gbuffer_;
    Port<const SurfaceVoxels> voxels_;  ///< With Visibility::Voxels.
    Port<FrameImage> direct_;
    Program aim_, add_;
    Sampler sampler_;
    Buffer rays_, carried_, occluded_;
    PaneTint tint_;
    VoxelTracer voxelTracer_{VoxelWalk::Bricks};  ///< With Visibility::Voxels. All walks tell the same.
};

}  // namespace voxray
