#include "passes/common/triangle_walk/raster_walk.h"
#include "passes/common/triangle_walk/walk_types.h"

namespace voxray {
namespace {

/// Each axis projects every triangle onto a grid of `samples` squared points a voxel. Source: Magalhães 2020,
/// section 3.2.4.2; the area weights are ours (three_axis.glsl).
class ThreeAxisWalk final : public RasterWalk {
 public:
    explicit ThreeAxisWalk(uint32_t samples) : samples_(samples) {}

    void prepare(PassSetup& setup) override {
        vertex_ = setup.compiler.compile("passes/common/triangle_walk/three_axis.vert");
    }

    Program compileVisitor(PassSetup& setup, const std::string& shader,
                           const Defines& defines) const override {
        const ShaderModule modules[] = {vertex_, setup.compiler.compile(shader + ".frag", defines)};
        return makeRasterProgram(setup.device, modules, {});
    }

    void run(PassContext& context, const Program& visitor, const gpu::VoxelGrid& grid,
             std::span<const Binding> bindings, float visitorScale) const override {
        const std::vector<Binding> all = allBindings(context, bindings);
        gpu::TriangleWalkPush push{};
        push.grid = grid;
        push.visitorScale = visitorScale;
        push.samples = samples_;
        for (push.axis = 0; push.axis < 3; ++push.axis) {
            // The image plane is spanned by the two axes that follow in cyclic order.
            RasterTargets targets;
            targets.extent = {grid.resolution[int(push.axis + 1) % 3] * samples_,
                              grid.resolution[int(push.axis + 2) % 3] * samples_, 1};
            context.stream.draw(visitor, all, push, targets, corners());
        }
    }

 private:
    uint32_t samples_;
    ShaderModule vertex_;
};

}  // namespace

std::unique_ptr<TriangleWalk> makeThreeAxisWalk(uint32_t samples) {
    return std::make_unique<ThreeAxisWalk>(samples);
}

}  // namespace voxray
