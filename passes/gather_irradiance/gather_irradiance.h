#pragma once

#include "passes/common/voxel_lookup.h"

namespace voxray {

/// Indirect light per pixel from the voxels at the surface: albedo / pi times the irradiance that the voxels
/// hold there. Source: Magalhães 2020, section 3.4.
class GatherIrradiance final : public Pass {
 public:
    static constexpr const char* kName = "gather_irradiance";
    static constexpr const char* kHelp =
        "Indirect light: looks the voxels' irradiance up at each pixel's surface, interpolated, for the "
        "surface's normal. "
        "Biased by: voxel size (detail below it is lost, light creeps round thin edges). Lambert surfaces "
        "only. "
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

    explicit GatherIrradiance(const Params& params) : params_(params) {}
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
    Port<FrameImage> indirect_;
    VoxelLookup lookup_;
};

}  // namespace voxray
