#include <algorithm>

#include "base/error.h"
#include "passes/common/compute/dispatch.h"
#include "passes/common/octree/octree_builder.h"
#include "passes/filter_voxels/radiance_storage.h"
#include "passes/filter_voxels/svo_collapse.h"
#include "passes/filter_voxels/svo_values.h"

namespace voxray {
namespace {

struct OctreeSurfacePush {
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
        const OctreeSize size{radiance.grid.resolution, voxels.expectedCounts};
        const uint64_t octree = size.bytes() + svoValueBytes(size, radiance.grid.directions);
        plan.reserve("octree (estimated)", octree);
        const uint64_t lists = size.leafBytes() + SvoFilter::changedBytes(size);
        const uint64_t building = OctreeBuilder::scratchBytes(size);
        if (plan.phase == Phase::Frame) {
            plan.reserve("leaves and changes (estimated)", lists);
            plan.reserveScratch("building (estimated)", building);
        } else {
            // A collapsed octree next to the first one.
            const uint64_t collapsing = octree + SvoCollapse::scratchBytes(size);
            plan.reserveScratch("leaves and changes (estimated)", lists);
            plan.reserveScratch("building, then collapsing (at most)", std::max(building, collapsing));
        }
    }

    void prepare(PassSetup& setup, RadianceVoxels&) override {
        surface_ =
            makeComputeProgram(setup.device, setup.compiler.compile("passes/filter_voxels/svo_surface.comp"));
        builder_.emplace(setup.device, setup.compiler);
        filter_ = SvoFilter(setup.device, setup.compiler);
        collapse_.emplace(setup.device, setup.compiler);
        version_.reset();
    }

    void run(PassContext& context, const SurfaceVoxels& voxels, const SurfaceLight& light,
             RadianceVoxels& radiance, float emission) override {
        CommandStream& stream = context.stream;
        // All is new where the voxels are; else what has another value.
        const bool rebuilt = version_ != voxels.version;
        if (rebuilt) {
            radiance.octree = {};
            radiance.storage.clear();
            changed_ = {};
            allocateSvoValues(stream, builder_->build(stream, voxels), radiance);
            version_ = voxels.version;
            changed_ =
                Buffer(context.device, "octree changes", SvoFilter::changedBytes(radiance.octree.size));
        }
        stream.fill(changed_, rebuilt ? ~0u : 0u);

        const OctreeSize& size = radiance.octree.size;
        std::vector<Binding> bindings = surfaceRadianceBindings(voxels, light);
        for (const Binding& binding : radiance.bindings()) bindings.push_back(binding);
        bindings.insert(bindings.end(), {{"leaves", radiance.octree.leafVoxels}, {"changed", changed_}});
        stream.dispatch(surface_, bindings,
                        OctreeSurfacePush{voxels.grid, emission, size.first()[0], size.nodes[0]},
                        linearGroups(size.nodes[0]));
        filter_.run(stream, radiance, changed_);
    }

    void close(CommandStream& stream, RadianceVoxels& radiance) override {
        // What is not filtered again needs no more than its values.
        collapse_->run(stream, radiance);
        radiance.octree.leafVoxels = {};
        changed_ = {};
        version_.reset();
    }

 private:
    Program surface_;
    std::optional<OctreeBuilder> builder_;
    SvoFilter filter_;
    std::optional<SvoCollapse> collapse_;
    std::optional<uint64_t> version_;  ///< Of the voxels that it is built of.
    Buffer changed_;
};

}  // namespace

std::unique_ptr<RadianceStorage> makeSvoStorage() {
    return std::make_unique<SvoStorage>();
}

}  // namespace voxray
