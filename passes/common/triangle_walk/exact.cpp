#include "passes/common/compute/dispatch.h"
#include "passes/common/triangle_walk/triangle_tiles.h"
#include "passes/common/triangle_walk/voxelize_method.h"

namespace voxray {
namespace {

struct Push {
    gpu::VoxelGrid grid;
    uint32_t tileCount;
    float scale;
};

/// Triangle-box overlap by separating axes. A thread takes one tile of a triangle and walks its columns. What
/// a voxel holds of a triangle is the triangle clipped to the voxel. Sources: Schwarz and Seidel 2010,
/// section 4 (overlap); Sutherland and Hodgman 1974 (clipping).
class Exact final : public VoxelizeMethod {
 public:
    void plan(PassPlan& plan, const SurfaceVoxels& voxels) override {
        plan.reserveScratch("tiles of triangles",
                            TriangleTiles::bytes(plan.frame.scene->geometry, voxels.grid));
    }

    void prepare(PassSetup& setup) override {
        for (const bool mark : {false, true})
            (mark ? mark_ : add_) = makeComputeProgram(
                setup.device,
                setup.compiler.compile("passes/common/triangle_walk/exact.comp", stepDefines(mark)));
    }

    void select(PassContext& context, const gpu::VoxelGrid& grid, const VoxelRegion& region,
                const std::vector<uint32_t>& triangles) override {
        tiles_ = TriangleTiles(context.stream, context.frame.scene->geometry, grid, region, triangles);
    }

    void release() override { tiles_ = {}; }

    void run(PassContext& context, const SurfaceVoxels& voxels, const VoxelizeStep& step) override {
        context.stream.dispatch(
            step.mark ? mark_ : add_, stepBindings(context, voxels, step, {{"tiles", tiles_.buffer()}}),
            Push{voxels.grid, tiles_.count(), step.emissionScale}, linearGroups(tiles_.count()));
    }

 private:
    Program mark_, add_;
    TriangleTiles tiles_;
};

}  // namespace

std::unique_ptr<VoxelizeMethod> makeExact() {
    return std::make_unique<Exact>();
}

}  // namespace voxray
