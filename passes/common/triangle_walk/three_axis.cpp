#include "passes/common/triangle_walk/voxelize_method.h"

namespace voxray {
namespace {

struct Push {
    gpu::VoxelGrid grid;
    uint32_t axis;
    uint32_t samples;
    float emissionScale;
};

/// Each axis projects every triangle onto a grid of `samples` squared points a voxel. A fragment of a
/// triangle with unit normal n, seen along axis a, weighs |n_a| / samples²; over the three axes that sums to
/// the triangle's area in units of voxel faces (because n_x² + n_y² + n_z² = 1). Source: Magalhães 2020,
/// section 3.2.4.2; the area weights are ours.
class ThreeAxis final : public RasterMethod {
 public:
    explicit ThreeAxis(uint32_t samples) : samples_(samples) {}

    void prepare(PassSetup& setup) override {
        const ShaderModule vertex = setup.compiler.compile("passes/common/triangle_walk/three_axis.vert");
        for (const bool mark : {false, true}) {
            const ShaderModule modules[] = {
                vertex,
                setup.compiler.compile("passes/common/triangle_walk/three_axis.frag", stepDefines(mark))};
            (mark ? mark_ : add_) = makeRasterProgram(setup.device, modules, {});
        }
    }

    void run(PassContext& context, const SurfaceVoxels& voxels, const VoxelizeStep& step) override {
        const std::vector<Binding> read = bindings(context, voxels, step);
        for (uint32_t axis = 0; axis < 3; ++axis) {
            // The image plane is spanned by the two axes that follow in cyclic order.
            RasterTargets targets;
            targets.extent = {voxels.grid.resolution[int(axis + 1) % 3] * samples_,
                              voxels.grid.resolution[int(axis + 2) % 3] * samples_, 1};
            context.stream.draw(step.mark ? mark_ : add_, read,
                                Push{voxels.grid, axis, samples_, step.emissionScale}, targets, corners());
        }
    }

 private:
    uint32_t samples_;
    Program mark_, add_;
};

}  // namespace

std::unique_ptr<VoxelizeMethod> makeThreeAxis(uint32_t samples) {
    return std::make_unique<ThreeAxis>(samples);
}

}  // namespace voxray
