#include <algorithm>

#include "base/error.h"
#include "passes/common/triangle_walk/raster_walk.h"

namespace voxray {
namespace {

/// One raster pass. A geometry shader picks the axis that a triangle faces most; pixels are columns of voxels
/// along it. A pixel is drawn for each column that the triangle touches (not only for those whose center it
/// contains) and reaches each voxel that the triangle's plane passes through there. Sources: Magalhães 2020,
/// section 3.2.4.3; Crassin and Green 2012; Hasselgren et al. 2005 for growing triangles by half a pixel.
///
/// With `samples`, as published in Arnebäck 2017, section 3.2.1: a pixel reaches one voxel alone, at the
/// depth of the plane in its center, where one of its sample points is in the triangle.
class DominantAxisWalk final : public RasterWalk {
 public:
    explicit DominantAxisWalk(uint32_t samples) : samples_(samples) {}

    void plan(PassPlan& plan) override {
        if (!plan.device.geometryShader)
            throw Error("{} needs geometry shaders (geometryShader), which device '{}' lacks; use {}",
                        samples_ > 0 ? "voxelize_octree" : "voxelize: method dominant_axis", plan.device.name,
                        samples_ > 0 ? "voxelize and filter_voxels" : "method exact");
        RasterWalk::plan(plan);
    }

    std::unique_ptr<PassProgram> makeVisitor(ProgramOwner& owner, const std::string& shader,
                                             const Defines& defines) const override {
        Defines all = defines;
        all.emplace(samples_ > 0 ? "SAMPLED_AXIS" : "DOMINANT_AXIS", "1");
        const std::vector<std::string> files{"passes/common/triangle_walk/dominant_axis.vert",
                                             "passes/common/triangle_walk/dominant_axis.geom",
                                             shader + ".frag"};
        return std::make_unique<RasterPipeline>(owner, files, RasterState{}, all);
    }

    void run(PassContext& context, const Program& visitor, const gpu::VoxelGrid& grid,
             std::span<const Binding> bindings, float visitorScale) const override {
        // One square image has room for the columns along any axis.
        const uint32_t side = std::max({grid.resolution.x, grid.resolution.y, grid.resolution.z});
        RasterTargets targets;
        targets.extent = {side, side, 1};
        context.stream.draw(visitor, targets, corners(),
                            {allBindings(context, bindings),
                             {"grid", grid},
                             {"visitorScale", visitorScale},
                             {"tiles", 0u},
                             {"axis", 0u},
                             {"samples", samples_},
                             {"imageSide", side}});
    }

 private:
    uint32_t samples_;  ///< A pixel; 0: conservatively.
};

}  // namespace

std::unique_ptr<TriangleWalk> makeDominantAxisWalk() {
    return std::make_unique<DominantAxisWalk>(0);
}

std::unique_ptr<TriangleWalk> makeSampledAxisWalk(uint32_t samples) {
    return std::make_unique<DominantAxisWalk>(samples);
}

}  // namespace voxray
