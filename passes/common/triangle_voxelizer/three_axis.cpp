#include "passes/common/triangle_voxelizer/raster_voxelizer.h"

namespace voxray {
namespace {

/// Projects all triangles along each axis onto a grid of samples² points per voxel face. Source: Magalhães
/// 2020, section 3.2.4.2; the area weights are ours (three_axis.glsl).
class ThreeAxisVoxelizer final : public RasterVoxelizer {
 public:
    explicit ThreeAxisVoxelizer(uint32_t samples) : samples_(samples) {}

    std::unique_ptr<PassProgram> makeProgram(ProgramOwner& owner, const std::string& shader,
                                             const Defines& defines) const override {
        const std::vector<std::string> files{"passes/common/triangle_voxelizer/three_axis.vert", shader + ".frag"};
        return std::make_unique<RasterPipeline>(owner, files, RasterState{}, defines);
    }

    void run(PassContext& context, const Program& program, const gpu::VoxelGrid& grid,
             std::span<const Binding> bindings, float fixedPointScale) const override {
        const std::vector<Binding> shared = allBindings(context, bindings);
        for (uint32_t axis = 0; axis < 3; ++axis) {
            // The next two axes in cyclic order span the image.
            RasterTargets targets;
            targets.extent = {grid.resolution[int(axis + 1) % 3] * samples_,
                              grid.resolution[int(axis + 2) % 3] * samples_, 1};
            context.stream.draw(program, targets, corners(),
                                {shared,
                                 {"grid", grid},
                                 {"fixedPointScale", fixedPointScale},
                                 {"tiles", 0u},
                                 {"axis", axis},
                                 {"samples", samples_}});
        }
    }

 private:
    uint32_t samples_;
};

}  // namespace

std::unique_ptr<TriangleVoxelizer> makeThreeAxisVoxelizer(uint32_t samples) {
    return std::make_unique<ThreeAxisVoxelizer>(samples);
}

}  // namespace voxray
