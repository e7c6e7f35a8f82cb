#include "graph/registry.h"
#include "passes/common/view/gbuffer.h"
#include "passes/common/voxel_march/voxel_march.h"

namespace voxray {

/// Which pixels' surfaces see the surface at one of them, through voxels.
class MutualVisibility final : public Pass {
 public:
    static constexpr const char* kName = "mutual_visibility";
    static constexpr const char* kHelp = "1 where a pixel's surface sees the surface at pixel (x, y), else 0.";
    struct Params {
        uint32_t x = 0, y = 0;
        static constexpr auto schema() {
            return std::tuple{field("x", &Params::x, "Column of the pixel.", 0u, 4095u),
                              field("y", &Params::y, "Its row.", 0u, 4095u)};
        }
    };
    explicit MutualVisibility(const Params& params) : params_(params) {}

    void plan(PassPlan& plan) override {
        march_.plan(plan, plan[voxels_]);
        plan.frameImage(seen_);
    }
    void record(PassContext& context) override {
        const SurfaceVoxels& voxels = context[voxels_];
        march_.begin(context.stream, voxels);
        context.dispatch(kernel_, context.frame.pixels(),
                         {context[gbuffer_],
                          march_,
                          {"seen", context[seen_].image},
                          {"grid", voxels.grid},
                          {"pixel", glm::uvec2(params_.x, params_.y)}});
        context.marchCounters.push_back(&march_.counts());
    }

 private:
    const Params params_;
    In<GBuffer> gbuffer_{*this, "gbuffer", "what the camera sees, a texel a pixel"};
    In<SurfaceVoxels> voxels_{*this, "voxels", "what hides surfaces from each other"};
    Out<FrameImage> seen_{*this, "seen", "1 or 0"};
    VoxelMarch march_{*this, VoxelTraversal::Bricks};
    Kernel kernel_{*this, "mutual_visibility.comp", march_.defines()};
};
VOXRAY_REGISTER_PASS(MutualVisibility);

}  // namespace voxray
