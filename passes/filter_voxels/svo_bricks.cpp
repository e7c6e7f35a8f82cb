#include <algorithm>

#include "base/error.h"
#include "passes/common/compute/dispatch.h"
#include "passes/common/octree/brick_octree_builder.h"
#include "passes/common/radiance/brick_radiance.h"
#include "passes/filter_voxels/radiance_storage.h"

namespace voxray {
namespace {

struct CellsPush {
    gpu::VoxelGrid grid;
};
struct SvoLeavesPush {
    gpu::VoxelGrid grid;
    float emission;
    gpu::LevelNodes nodes;
    uint32_t isMeasured;
};

/// The octree of Arnebäck 2017 as published, over our surface voxels: nodes with neighbours, bricks that are
/// filled by transfers and the three passes of its filter. All of it is built again where surfaces changed;
/// voxelize_octree keeps what stays apart. Docs: docs/svo.md.
class SvoBricksStorage final : public RadianceStorage {
 public:
    explicit SvoBricksStorage(const BrickParams& params) : neighbors_(params.brickNeighbors) {}

    void plan(PassPlan& plan, const SurfaceVoxels& voxels, RadianceVoxels& radiance) override {
        if (radiance.grid.directions != 1)
            throw Error(
                "filter_voxels: layout svo_bricks is as published: one value a voxel for all directions; "
                "here are {}. Set voxelize's 'directions' to 1, or set 'layout' to svo",
                radiance.grid.directions);
        octree_.expected = countBrickOctree(metVoxels(plan.frame.scene->geometry, voxels.grid), neighbors_);
        octree_.grid = voxels.grid;
        octree_.moves = !movingRuns(plan.frame.scene->geometry).empty();
        const BrickOctreeCount& count = octree_.expected;
        plan.reserveCounted("octree nodes (estimated)", octree_.room() * kBrickNodeBytes);
        plan.reserveScratch("nodes' flags (estimated)",
                            BrickOctreeBuilder::scratchBytes(count) + octree_.copyBytes() +
                                (count.levels[0].opaque + 1) * sizeof(uint32_t) + sizeof(VkDeviceAddress));
        BrickRadiance::plan(plan, radiance, count);
    }

    void prepare(PassSetup& setup, RadianceVoxels& radiance) override {
        builder_ = BrickOctreeBuilder(setup.device, setup.compiler, neighbors_);
        cells_ = makeComputeProgram(setup.device,
                                    setup.compiler.compile("passes/filter_voxels/svo_bricks_cells.comp"));
        leaves_ = makeComputeProgram(
            setup.device,
            setup.compiler.compile("passes/filter_voxels/svo_bricks_leaves.comp", radiance.defines()));
        radiance_.prepare(setup, radiance);
        version_.reset();
    }

    void run(PassContext& context, const SurfaceVoxels& voxels, const SurfaceLight& light,
             RadianceVoxels& radiance, float emission) override {
        CommandStream& stream = context.stream;
        if (version_ != voxels.version) {
            build(stream, voxels);
            radiance_.follow(stream, octree_, radiance);
        }
        version_ = voxels.version;

        std::vector<Binding> bindings = surfaceRadianceBindings(voxels, light);
        for (const Binding& binding : radiance.bindings()) bindings.push_back(binding);
        const gpu::LevelNodes& leaves = octree_.levels[0];
        stream.fill(radiance.storage[0], 0);
        for (const uint32_t isMeasured : {0u, 1u})
            stream.dispatch(leaves_, bindings, SvoLeavesPush{voxels.grid, emission, leaves, isMeasured},
                            linearGroups(leaves.staticCount));
        radiance_.filter(stream, octree_, radiance);
    }

 private:
    void build(CommandStream& stream, const SurfaceVoxels& voxels) {
        const LargeBuffer cells(stream.device(), "voxels of leaves",
                                std::max(voxels.voxelCount, 1u) * sizeof(uint32_t));
        stream.dispatch(cells_, voxels.bindings({{"FragmentCellsAt", cells.at()}}), CellsPush{voxels.grid},
                        linearGroups(voxels.words()));
        builder_.build(stream, octree_, cells, voxels.voxelCount);
        stream.finish();
    }

    bool neighbors_;
    BrickOctreeBuilder builder_;
    Program cells_, leaves_;
    BrickRadiance radiance_;
    BrickOctree octree_;
    std::optional<uint64_t> version_;  ///< Of the voxels that it is built of.
};

}  // namespace

std::unique_ptr<RadianceStorage> makeSvoBricksStorage(const BrickParams& params) {
    return std::make_unique<SvoBricksStorage>(params);
}

}  // namespace voxray
