#pragma once

#include "passes/common/surfels/surfel_injection.h"
#include "passes/common/view/image_rays.h"

namespace voxray {

/// Rays from the camera: at each hit shadow rays to every light, and a diffuse ray on, with shadow rays of
/// its own. Both hits leave the irradiance that they find in their voxels. Source: Magalhães 2020,
/// section 3.3.2 (described there, not built).
class InjectCameraRays final : public Pass {
 public:
    static constexpr const char* kName = "inject_camera_rays";
    static constexpr const char* kHelp =
        "Traces rays from the camera; shadow rays measure the irradiance at their hits and at those of one "
        "diffuse ray from "
        "each, and each counts by the area that it stands for. Leaves unlit: what neither the view nor its "
        "secondary rays reach. Biased by: voxel size; "
        "voxels "
        "seen in part count the part that is seen. Noisy by: rays_per_image. Source: Magalhães 2020, section "
        "3.3.2.";
    struct Params : WriteParams {
        uint32_t raysPerImage = 1048576;
        uint32_t bounces = 8;
        uint32_t lightSamples = 1;
        static constexpr auto schema() {
            return std::tuple_cat(
                WriteParams::schema(),
                std::tuple{
                    field("rays_per_image", &Params::raysPerImage, "Rays from the camera.", 1u, 1u << 26)
                        .lessNoise(),
                    field("bounces", &Params::bounces,
                          "Bounces of light; Russian roulette by albedo ends paths early.", 0u, 32u),
                    field("light_samples", &Params::lightSamples,
                          "Shadow rays at each hit to the emissive surfaces, and to the environment.", 1u,
                          64u)});
        }
    };

    explicit InjectCameraRays(const Params& params) : params_(params) {}
    Phase phase() const override { return Phase::Frame; }
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    /// A batch of surfels with their irradiance, W/m².
    struct LitSurfels {
        Buffer surfels, direct, indirect;
        uint32_t count = 0;
    };
    void emit(PassContext& context, uint32_t firstRay, uint32_t rays);
    void light(PassContext& context, const PathScene& scene);

    Params params_;
    Port<const SurfaceVoxels> voxels_;
    Port<VoxelIrradiance> irradiance_;
    std::vector<LightSource> sources_;
    SurfelInjection injection_;
    ImageRays imageRays_;
    Program arrive_;
    Buffer rays_, hits_, count_;
    LitSurfels first_, second_;  ///< At the hits of the camera's rays, and of one ray on from each.
};

}  // namespace voxray
