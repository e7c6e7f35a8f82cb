#include <algorithm>

#include "base/error.h"
#include "passes/common/triangle_walk/raster_walk.h"
#include "passes/common/triangle_walk/walk_types.h"

namespace voxray {
namespace {

/// One raster pass. A geometry shader picks the axis that a triangle faces most; pixels are columns of voxels
/// along it. A pixel is drawn for each column that the triangle touches (not only for those whose center it
/// contains) and reaches each voxel that the triangle's plane passes through there. Sources: Magalhães 2020,
/// section 3.2.4.3; Crassin and Green 2012; Hasselgren et al. 2005 for growing triangles by half a pixel.
class DominantAxisWalk final : public RasterWalk {
 public:
    void plan(PassPlan& plan, const gpu::VoxelGrid& grid) override {
        if (!plan.device.geometryShader)
            throw Error(
                "voxelize: method dominant_axis needs geometry shaders (geometryShader), which device '{}' "
                "lacks; use method exact",
                plan.device.name);
        RasterWalk::plan(plan, grid);
    }

    void prepare(PassSetup& setup) override {
        vertex_ = setup.compiler.compile("passes/common/triangle_walk/dominant_axis.vert");
        geometry_ = setup.compiler.compile("passes/common/triangle_walk/dominant_axis.geom");
    }

    Program compileVisitor(PassSetup& setup, const std::string& shader,
                           const Defines& defines) const override {
        Defines all = defines;
        all.emplace("DOMINANT_AXIS", "1");
        const ShaderModule modules[] = {vertex_, geometry_, setup.compiler.compile(shader + ".frag", all)};
        return makeRasterProgram(setup.device, modules, {});
    }

    void run(PassContext& context, const Program& visitor, const gpu::VoxelGrid& grid,
             std::span<const Binding> bindings, float visitorScale) const override {
        // One square image has room for the columns along any axis.
        gpu::TriangleWalkPush push{};
        push.grid = grid;
        push.visitorScale = visitorScale;
        push.imageSide = std::max({grid.resolution.x, grid.resolution.y, grid.resolution.z});
        RasterTargets targets;
        targets.extent = {push.imageSide, push.imageSide, 1};
        context.stream.draw(visitor, allBindings(context, bindings), push, targets, corners());
    }

 private:
    ShaderModule vertex_, geometry_;
};

}  // namespace

std::unique_ptr<TriangleWalk> makeDominantAxisWalk() {
    return std::make_unique<DominantAxisWalk>();
}

}  // namespace voxray
