#include <string>

#include "passes/common/triangle_voxelizer/triangle_tiles.h"
#include "passes/common/triangle_voxelizer/triangle_voxelizer.h"

namespace voxray {
namespace {

/// Triangle-box overlap by separating axes, one tile of a triangle per thread. A fragment is the triangle
/// clipped to the voxel. Sources: Schwarz and Seidel 2010, section 4 (overlap); Sutherland and Hodgman 1974
/// (clipping).
class ExactVoxelizer final : public TriangleVoxelizer {
 public:
    std::unique_ptr<PassProgram> makeProgram(ProgramOwner& owner, const std::string& shader,
                                             const Defines& defines) const override {
        return std::make_unique<Kernel>(owner, shader + ".comp", defines);
    }

    void select(PassContext& context, const gpu::VoxelGrid& grid, const VoxelRegion& region,
                const std::vector<uint32_t>& triangles) override {
        tiles_ = TriangleTiles(context.stream, context.frame.scene->geometry, grid, region, triangles);
    }

    void run(PassContext& context, const Program& program, const gpu::VoxelGrid& grid,
             std::span<const Binding> bindings, float fixedPointScale) const override {
        context.dispatch(program, tiles_.count(),
                         {context.scene,
                          std::vector<Binding>(bindings.begin(), bindings.end()),
                          {"triangleTiles", tiles_.buffer()},
                          {"grid", grid},
                          {"fixedPointScale", fixedPointScale},
                          {"tiles", tiles_.count()},
                          {"axis", 0u},
                          {"samples", 0u}});
    }

    void release() override { tiles_ = {}; }

 private:
    TriangleTiles tiles_;
};

}  // namespace

std::unique_ptr<TriangleVoxelizer> makeExactVoxelizer() {
    return std::make_unique<ExactVoxelizer>();
}

}  // namespace voxray
