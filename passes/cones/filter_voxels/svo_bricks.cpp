#include <algorithm>

#include "base/error.h"
#include "passes/common/octree/brick_octree_builder.h"
#include "passes/cones/filter_voxels/radiance_storage.h"
#include "passes/cones/radiance/brick_radiance.h"

namespace voxray {
namespace {

/// The octree of Arnebäck 2017 as published, over our surface voxels: nodes with neighbor pointers, and
/// bricks that are filled by transfers and a filter in three passes. Rebuilt as a whole when surfaces change;
/// voxelize_octree has a static section. Docs: docs/svo.md.
class SvoBricksStorage final : public RadianceStorage {
 public:
    SvoBricksStorage(ProgramOwner& owner, const BrickParams& params)
        : neighbors_(params.brickNeighbors),
          builder_(owner, neighbors_),
          listCells_(owner, "svo_bricks_list_cells.comp"),
          fillLeaves_(owner, "svo_bricks_fill_leaves.comp"),
          radiance_(owner) {}

    void plan(PassPlan& plan, const SurfaceVoxels& voxels, RadianceVoxels& radiance) override {
        if (radiance.grid.directions != 1)
            throw Error(
                "filter_voxels: layout svo_bricks is as published: one value a voxel for all directions; "
                "here are {}. Set voxelize's 'directions' to 1, or set 'layout' to svo",
                radiance.grid.directions);
        octree_.grid = voxels.grid;
        octree_.moves = !movingInstanceRanges(plan.frame.scene->geometry).empty();
        // With neighbors a surface is about two layers thick at the grid's border, three elsewhere. Each
        // level has a quarter of the voxels of the one below, and eight nodes for each brick of the one
        // above.
        plan.estimate(voxels.estimatedCount * (neighbors_ ? 8.0 / 3 : 4.0 / 3) * (2 * kBrickNodeBytes + kBrickBytes));
        BrickRadiance::plan(plan, radiance);
        fillLeaves_.define(radiance.defines());
    }

    void run(PassContext& context, const SurfaceVoxels& voxels, const SurfaceLight& light, RadianceVoxels& radiance,
             float emission) override {
        CommandStream& stream = context.stream;
        if (version_ != voxels.version) {
            build(stream, voxels);
            radiance_.setOctree(stream, octree_, radiance);
        }
        version_ = voxels.version;

        const gpu::LevelNodes& leaves = octree_.levels[0];
        stream.fill(radiance.storage[0], 0);
        for (const uint32_t scaleIsKnown : {0u, 1u})
            context.dispatch(
                fillLeaves_, leaves.staticCount,
                {voxels, light, radiance, {"emission", emission}, {"nodes", leaves}, {"scaleIsKnown", scaleIsKnown}});
        radiance_.filter(stream, octree_, radiance);
    }

 private:
    void build(CommandStream& stream, const SurfaceVoxels& voxels) {
        const LargeBuffer cells(stream.device(), "voxels of leaves",
                                std::max(voxels.voxelCount, 1u) * sizeof(uint32_t));
        stream.dispatch(listCells_, voxels.words(), {voxels, {"FragmentCellsRef", cells.ref()}});
        builder_.build(stream, octree_, cells, voxels.voxelCount);
        stream.finish();
    }

    bool neighbors_;
    BrickOctreeBuilder builder_;
    Kernel listCells_, fillLeaves_;
    BrickRadiance radiance_;
    BrickOctree octree_;
    std::optional<uint64_t> version_;  ///< Of the voxels that it was built from.
};

}  // namespace

std::unique_ptr<RadianceStorage> makeSvoBricksStorage(ProgramOwner& owner, const BrickParams& params) {
    return std::make_unique<SvoBricksStorage>(owner, params);
}

}  // namespace voxray
