#include <fmt/format.h>

#include <string>

#include "passes/common/compute/dispatch.h"
#include "passes/common/triangle_walk/triangle_tiles.h"
#include "passes/common/triangle_walk/triangle_walk.h"
#include "passes/common/triangle_walk/walk_types.h"

namespace voxray {
namespace {

/// Triangle-box overlap by separating axes. A thread takes one tile of a triangle and walks its columns. A
/// fragment is the triangle clipped to the voxel. Sources: Schwarz and Seidel 2010, section 4 (overlap);
/// Sutherland and Hodgman 1974 (clipping).
class ExactWalk final : public TriangleWalk {
 public:
    void plan(PassPlan& plan, const gpu::VoxelGrid& grid) override {
        const glm::vec3& o = grid.origin;
        const glm::uvec3& r = grid.resolution;
        const std::string key = fmt::format("tiles for {} x {} x {} voxels of {} m from {} {} {} on", r.x,
                                            r.y, r.z, grid.voxelSize, o.x, o.y, o.z);
        plan.reserveScratch("tiles of triangles", plan.ofScene(key, [&] {
            return TriangleTiles::bytes(plan.frame.scene->geometry, grid);
        }));
    }

    void prepare(PassSetup&) override {}

    Program compileVisitor(PassSetup& setup, const std::string& shader,
                           const Defines& defines) const override {
        return makeComputeProgram(setup.device, setup.compiler.compile(shader + ".comp", defines));
    }

    void select(PassContext& context, const gpu::VoxelGrid& grid, const VoxelRegion& region,
                const std::vector<uint32_t>& triangles) override {
        tiles_ = TriangleTiles(context.stream, context.frame.scene->geometry, grid, region, triangles);
    }

    void run(PassContext& context, const Program& visitor, const gpu::VoxelGrid& grid,
             std::span<const Binding> bindings, float visitorScale) const override {
        std::vector<Binding> all = context.scene.bindings({{"tiles", tiles_.buffer()}});
        all.insert(all.end(), bindings.begin(), bindings.end());
        gpu::TriangleWalkPush push{};
        push.grid = grid;
        push.visitorScale = visitorScale;
        push.tiles = tiles_.count();
        context.stream.dispatch(visitor, all, push, linearGroups(tiles_.count()));
    }

    void release() override { tiles_ = {}; }

 private:
    TriangleTiles tiles_;
};

}  // namespace

std::unique_ptr<TriangleWalk> makeExactWalk() {
    return std::make_unique<ExactWalk>();
}

}  // namespace voxray
