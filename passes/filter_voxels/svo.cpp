#include <algorithm>

#include "base/error.h"
#include "passes/common/compute/dispatch.h"
#include "passes/common/octree/octree_builder.h"
#include "passes/common/octree/octree_collapse.h"
#include "passes/common/voxels/voxel_count.h"
#include "passes/filter_voxels/radiance_storage.h"

namespace voxray {
namespace {

struct SurfacePush {
    gpu::VoxelGrid grid;
    float emission;
    uint32_t firstLeaf;
    uint32_t count;
};

/// The structure is built of the voxels that there are, and kept for as long as they are the same and light
/// is filtered again.
class SvoStorage final : public RadianceStorage {
 public:
    void plan(PassPlan& plan, const SurfaceVoxels& voxels, RadianceVoxels& radiance) override {
        radiance.grid.unit = 1;  // Values have an exponent of their own.
        const OctreeSize size{radiance.grid.resolution, radiance.grid.directions,
                              countSurfaceVoxels(plan.frame.scene->geometry, voxels.grid)};
        plan.reserve("octree (estimated)", size.bytes());
        const uint64_t lists = uint64_t(size.nodes[0]) * sizeof(uint32_t) + OctreeBuilder::changedBytes(size);
        const uint64_t building = OctreeBuilder::scratchBytes(size);
        if (plan.phase == Phase::Frame) {
            plan.reserve("leaves and changes (estimated)", lists);
            plan.reserveScratch("building (estimated)", building);
        } else {
            // A collapsed octree beside the first one.
            const uint64_t collapsing = size.bytes() + OctreeCollapse::scratchBytes(size);
            plan.reserveScratch("leaves and changes (estimated)", lists);
            plan.reserveScratch("building, then collapsing (at most)", std::max(building, collapsing));
        }
    }

    void prepare(PassSetup& setup, RadianceVoxels&) override {
        surface_ = makeComputeProgram(setup.device,
                                      setup.compiler.compile("passes/common/octree/octree_surface.comp"));
        builder_.emplace(setup.device, setup.compiler);
        collapse_.emplace(setup.device, setup.compiler);
    }

    void run(PassContext& context, const SurfaceVoxels& voxels, const SurfaceLight& light,
             RadianceVoxels& radiance, float emission) override {
        CommandStream& stream = context.stream;
        // All is new where the voxels are; else what has another value.
        const bool anew = !built_ || version_ != voxels.version;
        if (anew) {
            built_.reset();
            changed_ = {};
            built_ = builder_->build(stream, voxels, radiance);
            version_ = voxels.version;
            changed_ = Buffer(context.device, "octree changes", OctreeBuilder::changedBytes(built_->size));
        }
        stream.fill(changed_, anew ? ~0u : 0u);

        const uint32_t leaves = built_->size.nodes[0];
        std::vector<Binding> bindings = surfaceRadianceBindings(voxels, light);
        bindings.insert(
            bindings.end(),
            {{"radianceVoxels", radiance.header}, {"leaves", built_->leaves}, {"changed", changed_}});
        stream.dispatch(surface_, bindings,
                        SurfacePush{voxels.grid, emission, built_->size.first()[0], leaves},
                        linearGroups(leaves));
        builder_->filter(stream, built_->size, radiance, changed_);
    }

    void close(CommandStream& stream, RadianceVoxels& radiance) override {
        // What is not filtered again needs no more than its values.
        collapse_->run(stream, built_->size, radiance);
        built_.reset();
        changed_ = {};
    }

 private:
    Program surface_;
    std::optional<OctreeBuilder> builder_;
    std::optional<OctreeCollapse> collapse_;
    std::optional<OctreeBuilder::Built> built_;
    uint64_t version_ = 0;  ///< Of the voxels that it is built of.
    Buffer changed_;
};

}  // namespace

std::unique_ptr<RadianceStorage> makeSvoStorage() {
    return std::make_unique<SvoStorage>();
}

}  // namespace voxray
