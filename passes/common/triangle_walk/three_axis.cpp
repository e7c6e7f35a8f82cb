#include "passes/common/triangle_walk/raster_walk.h"

namespace voxray {
namespace {

/// Each axis projects every triangle onto a grid of `samples` squared points a voxel. Source: Magalhães 2020,
/// section 3.2.4.2; the area weights are ours (three_axis.glsl).
class ThreeAxisWalk final : public RasterWalk {
 public:
    explicit ThreeAxisWalk(uint32_t samples) : samples_(samples) {}

    std::unique_ptr<PassProgram> makeVisitor(ProgramOwner& owner, const std::string& shader,
                                             const Defines& defines) const override {
        const std::vector<std::string> files{"passes/common/triangle_walk/three_axis.vert", shader + ".frag"};
        return std::make_unique<RasterPipeline>(owner, files, RasterState{}, defines);
    }

    void run(PassContext& context, const Program& visitor, const gpu::VoxelGrid& grid,
             std::span<const Binding> bindings, float visitorScale) const override {
        const std::vector<Binding> all = allBindings(context, bindings);
        for (uint32_t axis = 0; axis < 3; ++axis) {
            // The image plane is spanned by the two axes that follow in cyclic order.
            RasterTargets targets;
            targets.extent = {grid.resolution[int(axis + 1) % 3] * samples_,
                              grid.resolution[int(axis + 2) % 3] * samples_, 1};
            context.stream.draw(visitor, targets, corners(),
                                {all,
                                 {"grid", grid},
                                 {"visitorScale", visitorScale},
                                 {"tiles", 0u},
                                 {"axis", axis},
                                 {"samples", samples_},
                                 {"imageSide", 0u}});
        }
    }

 private:
    uint32_t samples_;
};

}  // namespace

std::unique_ptr<TriangleWalk> makeThreeAxisWalk(uint32_t samples) {
    return std::make_unique<ThreeAxisWalk>(samples);
}

}  // namespace voxray
