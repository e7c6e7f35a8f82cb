#include "passes/common/octree/octree_builder.h"
#include "passes/cones/filter_voxels/radiance_storage.h"
#include "passes/cones/filter_voxels/svo_collapse.h"
#include "passes/cones/filter_voxels/svo_values.h"

namespace voxray {
namespace {

/// Sparse voxel octree (Crassin et al. 2011). It is rebuilt when voxels change; when light changes, values
/// are filtered again. Docs: docs/svo.md.
class SvoStorage final : public RadianceStorage {
 public:
    explicit SvoStorage(ProgramOwner& owner)
        : surface_(owner, "svo_surface.comp"), builder_(owner), filter_(owner), collapse_(owner) {}

    void plan(PassPlan& plan, const SurfaceVoxels& voxels, RadianceVoxels& radiance) override {
        radiance.grid.unit = 1;  // Values have exponents.
        // Values of all levels, and a table of about a word per voxel.
        plan.estimate(voxels.estimatedCount * (4.0 / 3 * radiance.grid.directions + 0.5) * sizeof(glm::uvec2));
    }

    void run(PassContext& context, const SurfaceVoxels& voxels, const SurfaceLight& light, RadianceVoxels& radiance,
             float emission) override {
        CommandStream& stream = context.stream;
        // After a rebuild all nodes count as changed, else those with new values.
        const bool isRebuilt = version_ != voxels.version;
        if (isRebuilt) {
            radiance.octree = {};
            radiance.storage.clear();
            changed_ = {};
            allocateSvoValues(stream, builder_.build(stream, voxels), radiance);
            version_ = voxels.version;
            changed_ = Buffer(context.device, "octree changes", SvoFilter::changedBytes(radiance.octree.size));
        }
        stream.fill(changed_, isRebuilt ? ~0u : 0u);

        const OctreeSize& size = radiance.octree.size;
        context.dispatch(surface_, size.nodes[0],
                         {voxels,
                          light,
                          radiance,
                          {"leaves", radiance.octree.leafVoxels},
                          {"changed", changed_},
                          {"emission", emission},
                          {"firstLeaf", size.first()[0]},
                          {"count", size.nodes[0]}});
        filter_.run(stream, radiance, changed_);
    }

    void finalize(CommandStream& stream, RadianceVoxels& radiance) override {
        collapse_.run(stream, radiance);
        radiance.octree.leafVoxels = {};
        changed_ = {};
        version_.reset();
    }

 private:
    Kernel surface_;
    OctreeBuilder builder_;
    SvoFilter filter_;
    SvoCollapse collapse_;
    std::optional<uint64_t> version_;  ///< Of the voxels that it was built from; none once finalized.
    Buffer changed_;
};

}  // namespace

std::unique_ptr<RadianceStorage> makeSvoStorage(ProgramOwner& owner) {
    return std::make_unique<SvoStorage>(owner);
}

}  // namespace voxray
