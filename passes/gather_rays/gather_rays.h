#pragma once

#include "passes/common/face_irradiance.h"
#include "passes/common/gather_hits.h"
#include "passes/common/gbuffer.h"

namespace voxray {

/// Indirect light by a final gather: rays find what each pixel sees, voxels tell how bright that is. Source:
/// Magalhães 2020 (hybrid of rays and voxels); filter: Dammertz et al. 2010 with the irradiance bound of Ward
/// et al. 1988 as its edge-stopping function.
class GatherRays final : public Pass {
 public:
    static constexpr const char* kName = "gather_rays";
    static constexpr const char* kHelp =
        "Indirect light: shades the hits of trace_gather_rays with the irradiance of the voxels there and "
        "their own albedo. "
        "Biased by: voxel size (light at the hits is as coarse as voxels, not at the pixel); `filter`. Noisy "
        "by: rays. Lambert surfaces only.";
    struct Params {
        uint32_t filter = 0;
        float strictness = 1.0f;
        static constexpr auto schema() {
            return std::tuple{
                field("filter", &Params::filter,
                      "Levels of the filter; each doubles its reach: 0 is none, n reaches 2^n - 1 texels.",
                      0u, 6u),
                field("strictness", &Params::strictness,
                      "Factor of the bias that the filter expects between texels (1: Ward's bound); more is "
                      "sharper and noisier.",
                      0.01f, 100.0f)};
        }
    };

    explicit GatherRays(const Params& params) : params_(params) {}
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
    Port<GatherHits> hits_;
    Port<FrameImage> indirect_;
    FaceIrradiance faces_;
    Program shade_, surroundRows_, surround_, filter_, resolve_;
    Sampler sampler_;
    Image gathered_, filtered_, moments_, surroundings_;
};

}  // namespace voxray
