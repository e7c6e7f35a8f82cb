#include <algorithm>

#include "base/error.h"
#include "passes/common/octree/brick_octree_builder.h"
#include "passes/cones/filter_voxels/radiance_storage.h"
#include "passes/cones/radiance/brick_radiance.h"

namespace voxray {
namespace {

/// The octree of Arnebäck 2017 as published, over our surface voxels: nodes with neighbours, bricks that are
/// filled by transfers and the three passes of its filter. All of it is built again where surfaces changed;
/// voxelize_octree keeps what stays apart. Docs: docs/svo.md.
class SvoBricksStorage final : public RadianceStorage {
 public:
    SvoBricksStorage(ProgramOwner& owner, const BrickParams& params)
        : neighbors_(params.brickNeighbors),
          builder_(owner, neighbors_),
          cells_(owner, "svo_bricks_cells.comp"),
          leaves_(owner, "svo_bricks_leaves.comp"),
          radiance_(owner) {}

    void plan(PassPlan& plan, const SurfaceVoxels& voxels, RadianceVoxels& radiance) override {
        if (radiance.grid.directions != 1)
            throw Error(
                "filter_voxels: layout svo_bricks is as published: one value a voxel for all directions; "
                "here are {}. Set voxelize's 'directions' to 1, or set 'layout' to svo",
                radiance.grid.directions);
        octree_.grid = voxels.grid;
        octree_.moves = !movingRuns(plan.frame.scene->geometry).empty();
        // With its neighbours a surface is some two layers thick at the grid's border, three elsewhere; each
        // level has a quarter of the one below, and eight nodes for each brick of the one above.
        plan.estimate(voxels.estimatedCount * (neighbors_ ? 8.0 / 3 : 4.0 / 3) *
                      (2 * kBrickNodeBytes + kBrickBytes));
        BrickRadiance::plan(plan, radiance);
        leaves_.define(radiance.defines());
    }

    void run(PassContext& context, const SurfaceVoxels& voxels, const SurfaceLight& light,
             RadianceVoxels& radiance, float emission) override {
        CommandStream& stream = context.stream;
        if (version_ != voxels.version) {
            build(stream, voxels);
            radiance_.follow(stream, octree_, radiance);
        }
        version_ = voxels.version;

        const gpu::LevelNodes& leaves = octree_.levels[0];
        stream.fill(radiance.storage[0], 0);
        for (const uint32_t isMeasured : {0u, 1u})
            context.dispatch(leaves_, leaves.staticCount,
                             {voxels,
                              light,
                              radiance,
                              {"emission", emission},
                              {"nodes", leaves},
                              {"isMeasured", isMeasured}});
        radiance_.filter(stream, octree_, radiance);
    }

 private:
    void build(CommandStream& stream, const SurfaceVoxels& voxels) {
        const LargeBuffer cells(stream.device(), "voxels of leaves",
                                std::max(voxels.voxelCount, 1u) * sizeof(uint32_t));
        stream.dispatch(cells_, voxels.words(), {voxels, {"FragmentCellsAt", cells.at()}});
        builder_.build(stream, octree_, cells, voxels.voxelCount);
        stream.finish();
    }

    bool neighbors_;
    BrickOctreeBuilder builder_;
    Kernel cells_, leaves_;
    BrickRadiance radiance_;
    BrickOctree octree_;
    std::optional<uint64_t> version_;  ///< Of the voxels that it is built of.
};

}  // namespace

std::unique_ptr<RadianceStorage> makeSvoBricksStorage(ProgramOwner& owner, const BrickParams& params) {
    return std::make_unique<SvoBricksStorage>(owner, params);
}

}  // namespace voxray
