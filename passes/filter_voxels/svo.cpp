#include "base/error.h"
#include "passes/common/dispatch.h"
#include "passes/common/voxel_count.h"
#include "passes/filter_voxels/octree_builder.h"
#include "passes/filter_voxels/octree_collapse.h"
#include "passes/filter_voxels/radiance_storage.h"

namespace voxray {
namespace {

struct SurfacePush {
    gpu::VoxelGrid grid;
    float emission;
    uint32_t firstLeaf;
    uint32_t count;
};

/// The structure is built on the first run, from the voxels that there are then, and kept for as long as
/// light is filtered again.
class SvoStorage final : public RadianceStorage {
 public:
    explicit SvoStorage(bool eachFrame) : eachFrame_(eachFrame) {}

    void plan(PassPlan& plan, const SurfaceVoxels& voxels, RadianceVoxels& radiance) override {
        radiance.grid.unit = 1;  // Values have an exponent of their own.
        const OctreeSize size{radiance.grid.resolution, radiance.grid.directions,
                              countSurfaceVoxels(plan.frame.scene->geometry, voxels.grid)};
        plan.reserve("octree (estimated)", size.bytes());
        plan.reserve("leaves (estimated)", uint64_t(size.nodes[0]) * sizeof(uint32_t));
        plan.reserve("building (estimated)", OctreeBuilder::scratchBytes(size));
    }

    void prepare(PassSetup& setup, RadianceVoxels&) override {
        surface_ = makeComputeProgram(setup.device,
                                      setup.compiler.compile("passes/filter_voxels/octree_surface.comp"));
        builder_.emplace(setup.device, setup.compiler);
        collapse_.emplace(setup.device, setup.compiler);
    }

    void run(PassContext& context, const SurfaceVoxels& voxels, const VoxelIrradiance& irradiance,
             RadianceVoxels& radiance, float emission) override {
        CommandStream& stream = context.stream;
        if (!built_) built_ = builder_->build(stream, voxels, radiance);
        std::vector<Binding> bindings = surfaceRadianceBindings(voxels, irradiance);
        for (const Binding& binding : radiance.bindings()) bindings.push_back(binding);
        bindings.emplace_back("leaves", built_->leaves);
        const uint32_t leaves = built_->size.nodes[0];
        stream.dispatch(surface_, bindings,
                        SurfacePush{voxels.grid, emission, built_->size.first()[0], leaves},
                        linearGroups(leaves));
        builder_->filter(stream, built_->size, radiance);
        if (eachFrame_) return;

        // What never changes again needs no more than its values.
        collapse_->run(stream, built_->size, radiance);
        built_.reset();
    }

 private:
    bool eachFrame_;
    Program surface_;
    std::optional<OctreeBuilder> builder_;
    std::optional<OctreeCollapse> collapse_;
    std::optional<OctreeBuilder::Built> built_;
};

}  // namespace

std::unique_ptr<RadianceStorage> makeSvoStorage(bool eachFrame) {
    return std::make_unique<SvoStorage>(eachFrame);
}

}  // namespace voxray
