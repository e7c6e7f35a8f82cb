#include <algorithm>

#include "base/error.h"
#include "passes/common/triangle_walk/voxelize_method.h"

namespace voxray {
namespace {

struct Push {
    gpu::VoxelGrid grid;
    uint32_t imageSide;
    float emissionScale;
};

/// One raster pass. A geometry shader picks the axis that a triangle faces most; pixels are columns of voxels
/// along it. A fragment is made for each column that the triangle touches (not only for those whose center it
/// covers) and reaches each voxel that the triangle's plane passes through there. Sources: Magalhães 2020,
/// section 3.2.4.3; Crassin and Green 2012; Hasselgren et al. 2005 for growing triangles by half a pixel.
class DominantAxis final : public RasterMethod {
 public:
    void plan(PassPlan& plan, const SurfaceVoxels& voxels) override {
        if (!plan.device.geometryShader)
            throw Error(
                "voxelize: method dominant_axis needs geometry shaders (geometryShader), which device '{}' "
                "lacks; use method exact",
                plan.device.name);
        RasterMethod::plan(plan, voxels);
    }

    void prepare(PassSetup& setup) override {
        const ShaderModule vertex = setup.compiler.compile("passes/common/triangle_walk/dominant_axis.vert");
        const ShaderModule geometry =
            setup.compiler.compile("passes/common/triangle_walk/dominant_axis.geom");
        for (const bool mark : {false, true}) {
            const ShaderModule modules[] = {
                vertex, geometry,
                setup.compiler.compile("passes/common/triangle_walk/dominant_axis.frag", stepDefines(mark))};
            (mark ? mark_ : add_) = makeRasterProgram(setup.device, modules, {});
        }
    }

    void run(PassContext& context, const SurfaceVoxels& voxels, const VoxelizeStep& step) override {
        // One square image has room for the columns along any axis.
        const glm::uvec3 r = voxels.grid.resolution;
        const uint32_t side = std::max({r.x, r.y, r.z});
        RasterTargets targets;
        targets.extent = {side, side, 1};
        context.stream.draw(step.mark ? mark_ : add_, bindings(context, voxels, step),
                            Push{voxels.grid, side, step.emissionScale}, targets, corners());
    }

 private:
    Program mark_, add_;
};

}  // namespace

std::unique_ptr<VoxelizeMethod> makeDominantAxis() {
    return std::make_unique<DominantAxis>();
}

}  // namespace voxray
