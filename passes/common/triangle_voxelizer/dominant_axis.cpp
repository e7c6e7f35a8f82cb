#include <glm/gtx/component_wise.hpp>

#include "base/error.h"
#include "passes/common/triangle_voxelizer/raster_voxelizer.h"

namespace voxray {
namespace {

/// Conservative rasterization in one pass. A geometry shader projects each triangle along its dominant axis;
/// a pixel is a column of voxels along it. Pixels are drawn for all columns that the triangle touches, and
/// yield all voxels that the triangle's plane passes through there. Sources: Magalhães 2020, section 3.2.4.3;
/// Crassin and Green 2012; Hasselgren et al. 2005 (triangles dilated by half a pixel).
///
/// With `samples`, as published in Arnebäck 2017, section 3.2.1: a pixel with a sample point in the triangle
/// yields one voxel, at the depth of the plane in the pixel's center.
class DominantAxisVoxelizer final : public RasterVoxelizer {
 public:
    explicit DominantAxisVoxelizer(uint32_t samples) : samples_(samples) {}

    void plan(PassPlan& plan) override {
        if (!plan.device.geometryShader)
            throw Error(
                "{} needs geometry shaders (geometryShader), which device '{}' lacks; use {}",
                samples_ > 0 ? "rasterization as in Arnebäck 2017" : "voxelize: method dominant_axis", plan.device.name,
                samples_ > 0 ? "voxelize and filter_voxels, or voxelize_clipmap and light_clipmap" : "method exact");
        RasterVoxelizer::plan(plan);
    }

    std::unique_ptr<PassProgram> makeProgram(ProgramOwner& owner, const std::string& shader,
                                             const Defines& defines) const override {
        Defines methodDefines = defines;
        methodDefines.emplace(samples_ > 0 ? "SAMPLED_AXIS" : "DOMINANT_AXIS", "1");
        const std::vector<std::string> files{"passes/common/triangle_voxelizer/dominant_axis.vert",
                                             "passes/common/triangle_voxelizer/dominant_axis.geom", shader + ".frag"};
        return std::make_unique<RasterPipeline>(owner, files, RasterState{}, methodDefines);
    }

    void run(PassContext& context, const Program& program, const gpu::VoxelGrid& grid,
             std::span<const Binding> bindings, float fixedPointScale) const override {
        // One square image that holds the columns along any axis.
        const uint32_t side = glm::compMax(grid.resolution - glm::uvec3(grid.first));
        RasterTargets targets;
        targets.extent = {side, side, 1};
        context.stream.draw(program, targets, corners(),
                            {allBindings(context, bindings),
                             {"grid", grid},
                             {"fixedPointScale", fixedPointScale},
                             {"tiles", 0u},
                             {"axis", 0u},
                             {"samples", samples_}});
    }

 private:
    uint32_t samples_;  ///< Per pixel; 0: conservative.
};

}  // namespace

std::unique_ptr<TriangleVoxelizer> makeDominantAxisVoxelizer() {
    return std::make_unique<DominantAxisVoxelizer>(0);
}

std::unique_ptr<TriangleVoxelizer> makeSampledAxisVoxelizer(uint32_t samples) {
    return std::make_unique<DominantAxisVoxelizer>(samples);
}

}  // namespace voxray
