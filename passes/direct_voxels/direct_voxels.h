#pragma once

#include "passes/common/voxel_lookup.h"

namespace voxray {

/// Direct light per pixel from the voxels at the surface, as the thesis has it: no shadow ray per pixel,
/// shadows no finer than a voxel. Source: Magalhães 2020, section 3.4.
class DirectVoxels final : public Pass {
 public:
    static constexpr const char* kName = "direct_voxels";
    static constexpr const char* kHelp =
        "Direct light from the voxels: no ray per pixel, but shadows and highlights no finer than a voxel. "
        "Biased by: voxel "
        "size. Noisy by: the injection's rays. Lambert surfaces only. Compare with direct_shadow_rays. "
        "Source: Magalhães 2020, section 3.4.";
    struct Params {
        float radius = 1.0f;
        static constexpr auto schema() {
            return std::tuple{
                field("radius", &Params::radius,
                      "Reach of the interpolation in voxels; 1 is trilinear, more is smoother and blurs.",
                      0.5f, 8.0f)};
        }
    };

    explicit DirectVoxels(const Params& params) : params_(params) {}
    Phase phase() const override { return Phase::Frame; }
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    Params params_;
    Port<GBuffer> gbuffer_;
    Port<SurfaceVoxels> voxels_;
    Port<VoxelIrradiance> irradiance_;
    Port<FrameImage> direct_;
    VoxelLookup lookup_;
};

}  // namespace voxray
