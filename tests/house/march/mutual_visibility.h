#pragma once

#include "passes/common/view/frame_image.h"
#include "passes/common/view/gbuffer.h"
#include "passes/common/voxel_march/voxel_march.h"

namespace voxray {

/// Which pixels' surfaces see the surface at one of them, through voxels.
class MutualVisibility final : public Pass {
 public:
    static constexpr const char* kName = "mutual_visibility";
    static constexpr const char* kHelp =
        "1 where a pixel's surface sees the surface at pixel (x, y), else 0.";
    struct Params {
        uint32_t x = 0, y = 0;
        static constexpr auto schema() {
            return std::tuple{field("x", &Params::x, "Column of the pixel.", 0u, 4095u),
                              field("y", &Params::y, "Its row.", 0u, 4095u)};
        }
    };

    explicit MutualVisibility(const Params& params) : params_(params) {}
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    Params params_;
    Port<const GBuffer> gbuffer_;
    Port<const SurfaceVoxels> voxels_;
    Port<FrameImage> seen_;
    VoxelMarch march_{VoxelWalk::Bricks};
    Program program_;
    Sampler sampler_;
};

}  // namespace voxray
